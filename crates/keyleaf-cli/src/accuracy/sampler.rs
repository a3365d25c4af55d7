//! A model of patches as the tessellators of `keyleaf-baseline` take it, and their triangles as a scene.

use glam::{DVec2, DVec3};
use keyleaf::draw::{Look, attributes};
use keyleaf::key::RootPoint;
use keyleaf::shading::Material;
use keyleaf::surface::{CornerAttributes, Faces, Mesh, Patches, PolygonMesh, Side, Surface};
use keyleaf_baseline::{Boundary, Sampler, Tessellation};
use keyleaf_stage::LoadedObject;
use std::sync::Arc;

/// A model of patches, with u and v as they are drawn.
pub struct PatchSampler<'a> {
    patches: &'a Patches,
    /// First and last knot of each surface in u and v.
    domains: Vec<[[f64; 2]; 2]>,
}

impl<'a> PatchSampler<'a> {
    pub fn new(patches: &'a Patches) -> Self {
        let ends = |knots: Vec<f64>| [knots[0], knots[knots.len() - 1]];
        let domain = |surface| patches.knots_of(surface).map(ends);
        Self {
            patches,
            domains: (0..patches.surfaces().len() as u32).map(domain).collect(),
        }
    }

    /// The point with parameters of a surface as it is drawn.
    fn address(&self, surface: usize, at: DVec2) -> RootPoint {
        let is_transposed = self
            .patches
            .report()
            .transposed
            .binary_search(&(surface as u32))
            .is_ok();
        // Rounding may lead out of the domain.
        let [low, high] = [0, 1].map(|end| {
            let [u, v] = &self.domains[surface];
            DVec2::new(u[end], v[end])
        });
        let at = at.clamp(low, high);
        let [s, t] = if is_transposed { [at.y, at.x] } else { [at.x, at.y] };
        let found = self.patches.own_coord(surface as u32, s, t);
        found.map_or_else(|error| unreachable!("{error}"), |coord| coord.at)
    }

    fn normal(&self, surface: usize, at: DVec2) -> [f32; 3] {
        self.patches
            .frame(self.address(surface, at))
            .normal
            .as_vec3()
            .to_array()
    }
}

fn side_of(side: keyleaf_baseline::Side) -> Side {
    match side {
        keyleaf_baseline::Side::UMin => Side::UMin,
        keyleaf_baseline::Side::UMax => Side::UMax,
        keyleaf_baseline::Side::VMin => Side::VMin,
        keyleaf_baseline::Side::VMax => Side::VMax,
    }
}

/// By the root of a KSQuad at that side.
const SIDES: [keyleaf_baseline::Side; 4] = [
    keyleaf_baseline::Side::VMin,
    keyleaf_baseline::Side::UMax,
    keyleaf_baseline::Side::VMax,
    keyleaf_baseline::Side::UMin,
];

impl Sampler for PatchSampler<'_> {
    fn surfaces(&self) -> usize {
        self.patches.surfaces().len()
    }

    fn point(&self, surface: usize, at: DVec2) -> DVec3 {
        self.patches.point(self.address(surface, at))
    }

    fn spans(&self, surface: usize) -> [Vec<f64>; 2] {
        self.patches.knots_of(surface as u32)
    }

    fn boundary(&self, surface: usize, side: keyleaf_baseline::Side) -> Boundary {
        let half_edges = self.patches.half_edges_of(surface as u32, side_of(side));
        let topology = self.patches.topology();
        let twins: Option<Vec<_>> = half_edges.iter().map(|h| topology.twin(h.face, h.root)).collect();
        let Some([first, rest @ ..]) = twins.as_deref() else {
            return Boundary::Free;
        };
        let Some(other) = self.patches.surface_of(first.face) else {
            return Boundary::Free;
        };
        // A side that meets parts of several others, beside a tear, stays free.
        let beyond = self.patches.half_edges_of(other, side_of(SIDES[first.root as usize]));
        let is_whole =
            beyond.len() == half_edges.len() && rest.iter().all(|twin| beyond.contains(twin)) && beyond.contains(first);
        if !is_whole {
            return Boundary::Free;
        }
        Boundary::Joined {
            surface: other as usize,
            side: SIDES[first.root as usize],
            reversed: runs_against(half_edges[0].root, first.root),
        }
    }
}

/// Whether the parameters of two joined sides grow in opposite directions: half-edges of a join run against each other, and those of
/// roots 0 and 1 run as the parameter grows.
fn runs_against(one: u32, other: u32) -> bool {
    (one < 2) == (other < 2)
}

/// The triangles with the exact normals at their corners, to be drawn as they are.
pub fn object_of(
    model: &LoadedObject,
    sampler: &PatchSampler<'_>,
    tessellation: &Tessellation,
) -> anyhow::Result<LoadedObject> {
    let mut mesh = PolygonMesh::default();
    let mut normals = Vec::new();
    let mut faces = Faces::new();
    for (triangle, (surface, at)) in tessellation.triangles.iter().zip(&tessellation.domains) {
        let first = mesh.positions.len() as u32;
        mesh.positions
            .extend(triangle.map(|vertex| tessellation.positions[vertex as usize]));
        normals.extend(at.map(|at| sampler.normal(*surface as usize, at)));
        faces.push(&[first, first + 1, first + 2]);
    }
    mesh.faces = faces;
    mesh.corners = CornerAttributes::default();
    let counts = vec![3; tessellation.triangles.len()];
    let surface: Arc<dyn Surface> = Arc::new(Mesh::new(&mesh)?);
    let mut settings = model.settings;
    settings.capacity = surface.topology().half_edge_count();
    (settings.base_grid, settings.max_level) = (0, 0);
    (settings.target_leaves, settings.cull) = (0, false);
    Ok(LoadedObject {
        look: Look {
            attributes: attributes(&counts, None, Some(&normals), None),
            texture: None,
        },
        material: Material::Attributes,
        surface,
        settings,
        ..model.clone()
    })
}
