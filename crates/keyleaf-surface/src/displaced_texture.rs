//! Meshes displaced by a texture. Twin of `shaders/surfaces/displaced_texture.wgsl`.

use crate::direction::round_up;
use crate::displaced::{DisplacementBound, SmoothMesh};
use crate::height_bounds::{Bounds, HeightBounds, HeightScale};
use crate::interpolation::interpolate;
use crate::mesh::POSITION_ERROR;
use crate::stencil::{Jet, Operand, root_speeds};
use crate::surface::uniform;
use crate::{
    HeightMap, Interpolation, MeshError, PolygonMesh, SettingError, Surface, SurfaceBound, SurfaceFrame, SurfaceTables,
    diamond,
};
use encase::ShaderType;
use glam::{DVec2, DVec3, IVec2};
use keyleaf_key::{HalfEdge, ONE, Place, RootPoint, Topology};

/// A texture of displacements: h = texel · scale + offset, in object units along the normal.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureDisplacement {
    /// The texels; texel i, j from below is at ((i + ½) / width, (j + ½) / height).
    pub texels: HeightMap,
    /// See above.
    pub scale: f64,
    /// See above.
    pub offset: f64,
    /// Whether the texture repeats; otherwise its rim goes on for ever.
    pub repeats: bool,
}

/// A mesh displaced along its smooth normals by a texture, interpolated bicubically at the corners' texture coordinates.
///
/// Where the coordinates of two faces differ at their common edge (a seam), the edge takes those of its owner, the half-edge with
/// the smaller index, and a vertex those of the first half-edge that starts there. So there is no crack; on the other side of a seam the
/// displacement jumps next to the edge if the texture does.
///
/// GPU memory: 32 bytes a vertex, 64 a face, 32 a corner, 5.4 a texel.
#[derive(Clone, Debug)]
pub struct DisplacedTexture {
    mesh: SmoothMesh,
    displacement: TextureDisplacement,
    /// Texture coordinate of every corner, and of every centre: the mean of its corners.
    uvs: Vec<DVec2>,
    centre_uvs: Vec<DVec2>,
    /// Whether the corners at either end of a half-edge, in both faces, have other coordinates than the owners of their vertices.
    is_seam: Vec<bool>,
    texel_speeds: Vec<f64>,
    bounds: HeightBounds,
}

#[derive(ShaderType)]
struct DisplacedTextureParams {
    vertices: u32,
    faces: u32,
    margin: f32,
    largest: f32,
    size: IVec2,
    scale: f32,
    offset: f32,
    repeats: u32,
    texel_margin: f32,
}

impl DisplacedTexture {
    /// The surface of a mesh with texture coordinates.
    ///
    /// # Errors
    /// [`MeshError`] if the mesh is no surface or has no coordinates, or a setting is not finite.
    pub fn new(mesh: &PolygonMesh, displacement: TextureDisplacement) -> Result<Self, MeshError> {
        let is_length = |length: f64| length.abs() <= 1e15;
        SettingError::check(
            "scale",
            displacement.scale,
            is_length(displacement.scale),
            "a length of at most 1e15",
        )?;
        SettingError::check(
            "offset",
            displacement.offset,
            is_length(displacement.offset),
            "a length of at most 1e15",
        )?;
        let round = |value: f64| f64::from(value as f32);
        let (scale, offset) = (round(displacement.scale), round(displacement.offset));
        let displacement = TextureDisplacement {
            scale,
            offset,
            ..displacement
        };
        let uvs = mesh.corners.uvs.as_ref().ok_or(MeshError::NoTextureCoordinates)?;
        let smooth = SmoothMesh::new(mesh)?;
        let uvs: Vec<DVec2> = uvs
            .iter()
            .map(|&[u, v]| DVec2::new(f64::from(u), f64::from(v)))
            .collect();
        let mut surface = Self {
            bounds: bounds(&displacement),
            centre_uvs: centre_uvs(&smooth.polygons.topology, &uvs),
            is_seam: seams(&smooth.polygons.topology, &uvs),
            mesh: smooth,
            displacement,
            uvs,
            texel_speeds: Vec::new(),
        };
        surface.texel_speeds = root_speeds(surface.topology(), |operand| surface.texel(operand).extend(0.0));
        Ok(surface)
    }

    fn size(&self) -> DVec2 {
        DVec2::new(
            f64::from(self.displacement.texels.width()),
            f64::from(self.displacement.texels.height()),
        )
    }

    /// The position of a corner or centre in the texture, in texels: texel (i, j) from below is at (i, j).
    fn texel(&self, operand: Operand) -> DVec2 {
        let uv = match operand {
            Operand::Corner(half_edge) => self.uvs[half_edge as usize],
            Operand::Centre(face) => self.centre_uvs[face as usize],
        };
        uv * self.size() - 0.5
    }

    /// The position of a point in the texture: on a mesh edge, that of the owner.
    fn owned_texel(&self, at: RootPoint) -> DVec2 {
        let topology = self.topology();
        let count = topology.corner_count(at.face);
        let owned_corner = |corner: u32| {
            let start = topology.vertex_owner(topology.vertex(at.face, corner));
            let HalfEdge { face, root } = start.unwrap_or(HalfEdge {
                face: at.face,
                root: corner,
            });
            self.texel(Operand::Corner(topology.half_edge_index(face, root)))
        };
        match at {
            RootPoint { x: ONE, .. } => owned_corner(at.root),
            RootPoint { y: ONE, .. } => owned_corner((at.root + 1) % count),
            _ if at.is_on_mesh_edge() => {
                let owner = topology.half_edge_owner(at.face, at.root);
                let is_own = owner
                    == (HalfEdge {
                        face: at.face,
                        root: at.root,
                    });
                let t = f64::from(if is_own { at.y } else { at.x }) / f64::from(ONE);
                let end = (owner.root + 1) % topology.corner_count(owner.face);
                let corner = |root| self.texel(Operand::Corner(topology.half_edge_index(owner.face, root)));
                corner(owner.root).lerp(corner(end), t)
            }
            _ => Jet::of(topology, at)
                .value(|operand| self.texel(operand).extend(0.0))
                .truncate(),
        }
    }

    /// (h, dh/di, dh/dj) at a position in texels.
    fn sample(&self, at: DVec2) -> [f64; 3] {
        let cell = at.floor();
        let texels = &self.displacement.texels;
        let texel = |i, j| {
            if self.displacement.repeats {
                texels.repeated(i, j)
            } else {
                texels.clamped(i, j)
            }
        };
        let index = [cell.x as i64, cell.y as i64];
        let [h, di, dj] = interpolate(Interpolation::Bicubic, texel, index, (at - cell).to_array());
        let scale = self.displacement.scale;
        [h * scale + self.displacement.offset, di * scale, dj * scale]
    }

    fn largest(&self) -> f64 {
        let bounds = self.bounds.of_map();
        f64::from(bounds.low.abs().max(bounds.high.abs()))
    }

    /// Bounds over a box of texel positions.
    fn over_texels(&self, low: DVec2, high: DVec2) -> Bounds {
        let size = [self.displacement.texels.width(), self.displacement.texels.height()].map(i64::from);
        let [first, last] = [low, high].map(|at| at.floor().to_array().map(|c| c as i64));
        if !self.displacement.repeats {
            let clamp = |at: [i64; 2]| [0, 1].map(|k| (at[k] + 1).clamp(0, size[k]) as u32);
            return self.bounds.over_cells(clamp(first), clamp(last));
        }
        let wrapped = [0, 1].map(|k| first[k].rem_euclid(size[k]));
        let end = [0, 1].map(|k| last[k] - first[k] + wrapped[k]);
        if (0..2).any(|k| end[k] >= size[k]) {
            return self.bounds.of_map();
        }
        self.bounds.over_cells(wrapped.map(|c| c as u32), end.map(|c| c as u32))
    }

    fn displacement_bound(&self, leaf: &Place) -> DisplacementBound {
        let root = self.topology().half_edge_index(leaf.face, leaf.root) as usize;
        let reach = self.texel_speeds[root] * diamond::ball_scale(leaf.level);
        let bounds = if diamond::crosses_edge(leaf) && self.is_seam[root] {
            self.bounds.of_map()
        } else {
            let middle = self.owned_texel(diamond::centre(leaf));
            self.over_texels(middle - reach, middle + reach)
        };
        let steepest = f64::from(bounds.slope) * reach;
        DisplacementBound {
            largest: self.largest(),
            variation: f64::from(bounds.high - bounds.low).min(steepest),
            steepest,
            typical: f64::from(bounds.slope) * self.texel_speeds[root] * diamond::level_scale(leaf.level),
            jump: if diamond::touches_edge(leaf) {
                self.jump(root)
            } else {
                0.0
            },
        }
    }

    fn jump(&self, root: usize) -> f64 {
        let bounds = self.bounds.of_map();
        if self.is_seam[root] {
            f64::from(bounds.high) - f64::from(bounds.low)
        } else {
            0.0
        }
    }

    /// `surface_b`: half-edges, then centres.
    fn words(&self) -> Vec<u32> {
        let topology = self.topology();
        let bits = |value: f64| (value as f32).to_bits();
        let half_edge = |index: usize| {
            let vertex = self.mesh.polygons.vertices[index];
            let owner = topology
                .vertex_owner(vertex)
                .map_or(index as u32, |h| topology.half_edge_index(h.face, h.root));
            let bounds = [
                self.mesh.polygons.speeds[index],
                self.mesh.normal_speeds[index],
                self.texel_speeds[index],
                self.jump(index),
            ]
            .map(|bound| round_up(bound).to_bits());
            let uv = self.uvs[index];
            [
                vertex,
                bounds[0],
                bounds[1],
                bounds[2],
                bits(uv.x),
                bits(uv.y),
                owner,
                bounds[3],
            ]
        };
        let centres = self.centre_uvs.iter().flat_map(|uv| [bits(uv.x), bits(uv.y), 0, 0]);
        (0..self.uvs.len()).flat_map(half_edge).chain(centres).collect()
    }

    /// The rounding error of a texture coordinate, in texels.
    fn texel_margin(&self) -> f64 {
        let largest = self
            .uvs
            .iter()
            .fold(0.0f64, |largest, uv| largest.max(uv.abs().max_element()));
        POSITION_ERROR * (largest + 1.0) * self.size().max_element()
    }
}

fn bounds(displacement: &TextureDisplacement) -> HeightBounds {
    let TextureDisplacement {
        texels,
        scale,
        offset,
        repeats,
    } = displacement;
    let scale = HeightScale {
        interpolation: Interpolation::Bicubic,
        scale: *scale,
        offset: *offset,
        slope: [scale.abs(), scale.abs()],
    };
    if *repeats {
        HeightBounds::new(
            0,
            [texels.width(), texels.height()],
            |i, j| texels.repeated(i, j),
            scale,
        )
    } else {
        // One more: the cells before the first texel and after the last.
        HeightBounds::new(
            -1,
            [texels.width() + 1, texels.height() + 1],
            |i, j| texels.clamped(i, j),
            scale,
        )
    }
}

fn centre_uvs(topology: &Topology, uvs: &[DVec2]) -> Vec<DVec2> {
    let mean = |face| {
        let (first, count) = (
            topology.first_half_edge(face) as usize,
            topology.corner_count(face) as usize,
        );
        uvs[first..first + count].iter().sum::<DVec2>() / count as f64
    };
    (0..topology.face_count()).map(mean).collect()
}

/// Both half-edges of an edge get the same answer.
fn seams(topology: &Topology, uvs: &[DVec2]) -> Vec<bool> {
    let differs = |face: u32, corner: u32| {
        let index = |h: HalfEdge| uvs[topology.half_edge_index(h.face, h.root) as usize];
        let own = index(HalfEdge { face, root: corner });
        topology
            .vertex_owner(topology.vertex(face, corner))
            .is_some_and(|owner| index(owner) != own)
    };
    let at_ends = |face: u32, root: u32| differs(face, root) || differs(face, (root + 1) % topology.corner_count(face));
    let is_seam = |root: Place| {
        let twin = topology.twin(root.face, root.root);
        at_ends(root.face, root.root) || twin.is_some_and(|twin| at_ends(twin.face, twin.root))
    };
    topology.roots().map(is_seam).collect()
}

impl Surface for DisplacedTexture {
    fn topology(&self) -> &Topology {
        &self.mesh.polygons.topology
    }

    fn point(&self, at: RootPoint) -> DVec3 {
        self.mesh.point(at, self.sample(self.owned_texel(at))[0])
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let h = self.sample(self.owned_texel(at))[0];
        self.mesh.frame(at, h, |weights, _, _, _| {
            let texel = weights.field(|operand| self.texel(operand).extend(0.0));
            let [h, di, dj] = self.sample(texel.value.truncate());
            [h, di * texel.du.x + dj * texel.du.y, di * texel.dv.x + dj * texel.dv.y]
        })
    }

    fn bound(&self, leaf: &Place) -> SurfaceBound {
        self.mesh
            .bound(leaf, self.point(diamond::centre(leaf)), self.displacement_bound(leaf))
    }

    fn bounding_box(&self) -> (DVec3, DVec3) {
        self.mesh.bounding_box(self.largest())
    }

    fn shader(&self) -> &'static str {
        "surfaces/displaced_texture.wgsl"
    }

    fn tables(&self, origin: DVec3) -> SurfaceTables {
        let polygons = &self.mesh.polygons;
        let texels = &self.displacement.texels;
        let steepest = f64::from(self.bounds.of_map().slope);
        let margin = self.mesh.margin(origin, self.largest(), 0.0) + steepest * self.texel_margin();
        let params = DisplacedTextureParams {
            vertices: polygons.vertex_count(),
            faces: polygons.topology.face_count(),
            margin: round_up(margin),
            largest: round_up(self.largest()),
            size: IVec2::new(texels.width() as i32, texels.height() as i32),
            scale: self.displacement.scale as f32,
            offset: self.displacement.offset as f32,
            repeats: u32::from(self.displacement.repeats),
            texel_margin: round_up(self.texel_margin()),
        };
        SurfaceTables {
            params: uniform(&params),
            a: self.mesh.table(origin),
            b: self.words(),
            heights: Some(texels.texture()),
            height_bounds: Some(self.bounds.texture()),
        }
    }
}
