//! What the GPU runs and reads to find a surface from a control mesh that moves.

/// The WGSL of the module `pose` for a kind of surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PoseShader {
    /// Files relative to the folder `shaders`, without those that they require.
    pub files: &'static [&'static str],
    /// Entry points, in the order of their dispatches.
    pub entries: &'static [&'static str],
    /// Whether bounds follow, which are in `surface_b`.
    pub finds_bounds: bool,
}

impl PoseShader {
    /// Catmull-Clark surfaces.
    pub const CATMULL_CLARK: Self = Self {
        files: &["passes/pose.wgsl", "shared/pose_square.wgsl"],
        entries: &["pose_faces", "pose_edges"],
        finds_bounds: true,
    };
    /// Loop surfaces.
    pub const LOOP: Self = Self {
        files: &["passes/pose.wgsl", "shared/pose_triangle.wgsl"],
        entries: &["pose_faces", "pose_edges"],
        finds_bounds: true,
    };
    /// Gaussian products, of both schemes.
    pub const GAUSSIAN: Self = Self {
        files: &["passes/pose_gaussian.wgsl"],
        entries: &["pose_faces"],
        finds_bounds: false,
    };
    /// QAS of the Loop limit surface.
    pub const QAS_LIMIT: Self = Self {
        files: &["shared/pose_limit.wgsl"],
        entries: &["pose_points", "pose_vertices", "pose_triangles", "pose_edges"],
        finds_bounds: true,
    };
    /// QAS through the vertices of a mesh.
    pub const QAS_BUTTERFLY: Self = Self {
        files: &["shared/pose_butterfly.wgsl"],
        entries: &["pose_points", "pose_vertices", "pose_triangles", "pose_edges"],
        finds_bounds: true,
    };
    /// PN triangles.
    pub const POINT_NORMAL: Self = Self {
        files: &["shared/pose_point_normal.wgsl"],
        entries: &["pose_vertices", "pose_triangles", "pose_edges"],
        finds_bounds: true,
    };
}

/// How much of a [`PoseShader`]'s entry point is dispatched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoseDispatch {
    /// So many workgroups.
    Groups(u32),
    /// Workgroups for so many invocations.
    Invocations(u32),
}

/// What the module `pose` reads of a surface that follows from the vertices of a control mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseTables {
    /// The uniform `pose`.
    pub params: Vec<u8>,
    /// The storage buffer `pose_words`.
    pub words: Vec<u32>,
    /// The storage buffer `pose_rows`: weights. Not empty.
    pub rows: Vec<f32>,
    /// Floats of the storage buffer `scratch`. Not zero.
    pub scratch: usize,
    /// Vertices of the control mesh.
    pub vertices: usize,
    /// Whether they come with covariances: axes and standard deviations.
    pub has_covariances: bool,
    /// One an entry point.
    pub dispatches: Vec<PoseDispatch>,
}

impl PoseTables {
    /// Entries of four floats that the GPU reads of all vertices of the control mesh.
    pub fn cage_entries(&self) -> usize {
        self.vertices * if self.has_covariances { 4 } else { 1 }
    }
}
