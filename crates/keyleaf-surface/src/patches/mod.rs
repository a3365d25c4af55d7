//! Bézier and NURBS surfaces. Twin of `shaders/surfaces/bezier*.wgsl` and `nurbs*.wgsl`.
//!
//! # Theory
//!
//! A face is a *KSQuad* (Concheiro 6.1): the product of two knot spans that are not empty. Its parameters run from 0 to 1 over each
//! span, and knots enter as distances from the span in units of its length, so that knots close together or far from zero lose
//! nothing. Derivatives come from differences of the control points of Q = w (P − S): at an edge whose control points are one point
//! they are exactly zero.
//!
//! # Practice
//!
//! | file | does |
//! |---|---|
//! | `nurbs_surface`, `span` | checks what users give; spans of knots |
//! | `basis`, `evaluation`, `normal` | a point of a KSQuad |
//! | `layout` | KSQuads, sides, tears |
//! | `boundary`, `join`, `orientation`, `weld` | which boundaries are the same curve |
//! | `even_spans`, `knot_insertion` | knot spans cut so that KSQuads become even |
//! | `gap` | which lie along each other without being the same |
//! | `addresses` | one address for every edge, corner and pole |
//! | `bezier_net`, `bound`, `local_deviation`, `normal_cone` | bounds |
//! | `tables` | what the GPU reads |

mod addresses;
mod basis;
mod bezier_net;
mod bound;
mod boundary;
mod classes;
mod error;
mod evaluation;
mod even_spans;
mod gap;
mod join;
mod knot_insertion;
mod layout;
mod local_deviation;
mod normal;
mod normal_cone;
mod nurbs_surface;
mod orientation;
mod power_form;
mod report;
mod span;
mod tables;
mod weld;

pub use basis::BasisMethod;
pub use error::PatchError;
pub use layout::Side;
pub use nurbs_surface::NurbsSurface;
pub use report::{Boundary, JoinReport, Pole, Unjoined};

use crate::quad_coord::QuadCoord;
use crate::root_bound::RootBound;
use crate::{OwnCoord, ParameterError, SettingError, Surface, SurfaceBound, SurfaceFrame, SurfaceTables, diamond};
use addresses::Addresses;
use evaluation::KsQuad;
use glam::DVec3;
use join::Joined;
use keyleaf_key::{HalfEdge, Place, RootPoint, Topology};
use layout::Layout;
use local_deviation::LocalDeviation;
use normal_cone::NormalCone;
use span::Fraction;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// The most control points of a row and of a model, for which the tables have room.
const MAX_ROW: usize = (1 << 24) - 1;
const MAX_POINTS: usize = 1 << 28;

/// The least tolerance that is too large: boundaries would join that everybody sees are apart.
const LARGEST_TOLERANCE: f64 = 0.01;

/// What the surfaces of a model are, and so which shader draws them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatchKind {
    /// Every surface is one Bézier patch, rational or not.
    Bezier,
    /// Any surface, with basis functions computed by this method.
    Nurbs(BasisMethod),
}

/// How a model of patches is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchSettings {
    /// Boundaries join when they are no farther apart than this part of the diagonal of the model's box; 0 to 0.01.
    pub tolerance: f64,
    /// What the surfaces are.
    pub kind: PatchKind,
    /// Whether the knot spans of a direction of a surface are cut into 2, 4 or 8 equal parts where its KSQuads are long in that
    /// direction, so that they take fewer triangles. No shape changes, and the same boundaries join; faces are those of the new KSQuads.
    /// Not for [`PatchKind::Bezier`], whose surfaces stay single patches.
    pub even_spans: bool,
}

impl Default for PatchSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-6,
            kind: PatchKind::Nurbs(BasisMethod::Triangular),
            even_spans: false,
        }
    }
}

/// A model of Bézier or NURBS surfaces, joined where their boundaries are the same curve.
///
/// Faces are the KSQuads of the surfaces, cut if [`PatchSettings::even_spans`] says so, in order, row by row: v outside, u inside.
/// Surfaces listed in [`JoinReport::transposed`] have u and v exchanged, so that neighbours have the same side up;
/// [`Surface::own_coord`] knows. The sides of an edge, and all
/// faces about a corner or a pole, take a point there from one of them.
///
/// Where the weights of a corner vanish, so that the surface has no one point there, a point close by stands for it, and bounds are
/// those that the extent of the control points suggests; elsewhere they are strict.
///
/// GPU memory: 16 bytes a control point, 1,420 a face (508 where there are more than 4,096 faces, 268 above 65,536), and the floats of
/// spans that differ.
///
/// ```
/// use glam::DVec3;
/// use keyleaf_surface::{NurbsSurface, PatchKind, PatchSettings, Patches, Surface};
/// let strip = |x: f64| {
///     let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[i, j]| DVec3::new(x + i, j, i * j));
///     NurbsSurface::bezier([1, 1], points.to_vec(), vec![1.0; 4])
/// };
/// let straight = NurbsSurface::bezier([1, 1], [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]
///     .map(DVec3::from_array).to_vec(), vec![1.0; 4])?;
/// let settings = PatchSettings { kind: PatchKind::Bezier, ..PatchSettings::default() };
/// let model = Patches::new(vec![strip(0.0)?, straight], settings)?;
/// assert_eq!((model.report().exact, model.report().unjoined.len()), (1, 6));
/// assert_eq!(model.point(model.face_coord(0, 1.0, 1.0)?), DVec3::new(1.0, 1.0, 1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Patches {
    kind: PatchKind,
    surfaces: Vec<NurbsSurface>,
    layouts: Vec<Layout>,
    transposed: Vec<bool>,
    /// How often knot spans were halved, by surface, in u and v as they were given.
    halvings: Vec<[u32; 2]>,
    surface_of_face: Vec<u32>,
    topology: Topology,
    addresses: Addresses,
    /// Mean normals of the faces.
    normals: Vec<DVec3>,
    /// By half-edge.
    bounds: Vec<RootBound>,
    deviations: LocalDeviation,
    /// How far the curves of a joined edge are apart.
    mismatch: f64,
    report: JoinReport,
    /// By face; made when the tables are.
    cones: OnceLock<Vec<Option<NormalCone>>>,
}

impl Patches {
    /// The model of these surfaces.
    ///
    /// # Errors
    /// [`PatchError`] if there is none, one is not of the kind or too large, or the tolerance is out of range.
    pub fn new(surfaces: Vec<NurbsSurface>, settings: PatchSettings) -> Result<Self, PatchError> {
        let PatchSettings {
            tolerance,
            kind,
            even_spans,
        } = settings;
        let is_possible = (0.0..=LARGEST_TOLERANCE).contains(&tolerance);
        SettingError::check("tolerance", tolerance, is_possible, "a number from 0 to 0.01")?;
        check_surfaces(&surfaces, kind)?;
        let Joined {
            surfaces,
            layouts,
            transposed,
            halvings,
            pairs,
            mismatch,
            report,
        } = join::join(surfaces, tolerance, even_spans && kind != PatchKind::Bezier);
        check_counts(&surfaces)?;
        let face_count = layouts.iter().map(Layout::face_count);
        let surface_of_face: Vec<u32> = (0..)
            .zip(face_count)
            .flat_map(|(surface, faces)| (0..faces).map(move |_| surface))
            .collect();
        let topology = Topology::glued(surface_of_face.iter().map(|_| 4), pairs)?;
        let quad_of = |face: u32| {
            let surface = surface_of_face[face as usize] as usize;
            quad(&surfaces[surface], &layouts[surface], face, kind)
        };
        let faces = || 0..topology.face_count();
        let addresses = Addresses::new(&topology, quad_of);
        let normals = faces().map(|face| normal::mean(&quad_of(face))).collect();
        let depth = local_deviation::depth_for(topology.face_count());
        let mut bounds = Vec::new();
        let second = faces().map(|face| {
            let bound = bound::of_quad(&quad_of(face), depth);
            bounds.extend(bound.roots);
            bound.second
        });
        let deviations = LocalDeviation::new(&topology, depth, second);
        let bounds = RootBound::of_both_sides(&topology, bounds);
        let mut patches = Self {
            kind,
            surfaces,
            layouts,
            transposed,
            halvings,
            surface_of_face,
            topology,
            addresses,
            normals,
            bounds,
            deviations,
            mismatch,
            report,
            cones: OnceLock::new(),
        };
        patches.report.poles = patches.poles();
        Ok(patches)
    }

    /// The normal cone of every face.
    fn cones(&self) -> &[Option<NormalCone>] {
        self.cones.get_or_init(|| {
            (0..self.topology.face_count())
                .map(|face| NormalCone::of(&self.quad(face)))
                .collect()
        })
    }

    /// How the surfaces were joined.
    pub fn report(&self) -> &JoinReport {
        &self.report
    }

    /// The surfaces as they are drawn: some transposed, with control points made equal where they join.
    pub fn surfaces(&self) -> &[NurbsSurface] {
        &self.surfaces
    }

    /// Into how many equal parts the knot spans of a surface were cut, in its own u and v: 1 or, with [`PatchSettings::even_spans`],
    /// up to 8. Its KSQuads are that many times as many as there were.
    pub fn parts_of_spans(&self, surface: u32) -> [u32; 2] {
        self.halvings[surface as usize].map(|n| 1 << n)
    }

    /// The surface of a face, none if there is no such face.
    pub fn surface_of(&self, face: u32) -> Option<u32> {
        self.surface_of_face.get(face as usize).copied()
    }

    /// The distinct knots of the domain of a surface, in u and v, as it is drawn.
    pub fn knots_of(&self, surface: u32) -> [Vec<f64>; 2] {
        let Layout { spans, .. } = &self.layouts[surface as usize];
        [&spans[0], &spans[1]].map(|spans| {
            let starts = spans.iter().map(|span| span.start);
            starts.chain(spans.last().map(|span| span.end)).collect()
        })
    }

    /// The half-edges of a side of a surface as it is drawn, in the direction in which its parameter grows.
    pub fn half_edges_of(&self, surface: u32, side: Side) -> Vec<HalfEdge> {
        let layout = &self.layouts[surface as usize];
        let [nu, nv] = [layout.spans[0].len(), layout.spans[1].len()];
        let spans = |i: usize| match side {
            Side::VMin => [i, 0],
            Side::UMax => [nu - 1, i],
            Side::VMax => [i, nv - 1],
            Side::UMin => [0, i],
        };
        let root = side as u32;
        let half_edge = |i| HalfEdge {
            face: layout.face(spans(i)),
            root,
        };
        (0..[nu, nv][side.along()]).map(half_edge).collect()
    }

    fn quad(&self, face: u32) -> KsQuad<'_> {
        let surface = self.surface_of_face[face as usize] as usize;
        quad(&self.surfaces[surface], &self.layouts[surface], face, self.kind)
    }

    /// Collapsed edges by the corner that all their corners share.
    fn poles(&self) -> Vec<Pole> {
        let mut faces_at: BTreeMap<_, Vec<u32>> = BTreeMap::new();
        for (root, corner) in self.topology.roots().zip(&self.addresses.corners) {
            let index = self.topology.half_edge_index(root.face, root.root) as usize;
            if self.addresses.collapsed[index] {
                faces_at.entry(*corner).or_default().push(root.face);
            }
        }
        faces_at
            .into_iter()
            .map(|(corner, mut faces)| {
                faces.dedup();
                let position = self.point(Place::of_root(corner.face, corner.root).corners()[1]);
                Pole { position, faces }
            })
            .collect()
    }
}

fn quad<'a>(surface: &'a NurbsSurface, layout: &'a Layout, face: u32, kind: PatchKind) -> KsQuad<'a> {
    let [i, j] = layout.spans_of(face);
    KsQuad {
        surface,
        spans: [&layout.spans[0][i], &layout.spans[1][j]],
        method: match kind {
            PatchKind::Bezier => BasisMethod::Triangular,
            PatchKind::Nurbs(method) => method,
        },
    }
}

fn check_surfaces(surfaces: &[NurbsSurface], kind: PatchKind) -> Result<(), PatchError> {
    if surfaces.is_empty() {
        return Err(PatchError::Empty);
    }
    check_counts(surfaces)?;
    for (number, surface) in (0..).zip(surfaces) {
        let is_bezier_span = surface.spans().iter().all(|spans| {
            let [span] = &spans[..] else { return false };
            span.is_clamped_at_start() && span.is_clamped_at_end()
        });
        let [p, q] = surface.degree().map(|degree| degree as usize + 1);
        if kind == PatchKind::Bezier && !(is_bezier_span && surface.points().len() == p * q) {
            return Err(PatchError::NotBezier { surface: number });
        }
    }
    Ok(())
}

fn check_counts(surfaces: &[NurbsSurface]) -> Result<(), PatchError> {
    let mut points = 0;
    for (number, surface) in (0..).zip(surfaces) {
        points += surface.points().len();
        // Either row may become the one that is stored.
        if points > MAX_POINTS || surface.point_counts().into_iter().any(|count| count > MAX_ROW) {
            return Err(PatchError::TooManyPoints { surface: number });
        }
    }
    Ok(())
}

impl Surface for Patches {
    fn topology(&self) -> &Topology {
        &self.topology
    }

    fn point(&self, at: RootPoint) -> DVec3 {
        let at = self.addresses.canonical(&self.topology, at);
        self.quad(at.face).jet(fractions(at)).position
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let quad = self.quad(at.face);
        let jet = quad.jet(fractions(at));
        SurfaceFrame {
            position: self.point(at),
            du: jet.du,
            dv: jet.dv,
            normal: normal::of(&quad, fractions(at), &jet, || self.normals[at.face as usize]),
        }
    }

    fn bound(&self, leaf: &Place) -> SurfaceBound {
        let bound = self.bounds[self.topology.half_edge_index(leaf.face, leaf.root) as usize];
        let [deviation, pair_deviation] = self.deviations.of(&self.topology, leaf);
        SurfaceBound {
            deviation,
            pair_deviation,
            ..bound.of_leaf(leaf, self.point(diamond::centre(leaf)), self.mismatch)
        }
    }

    fn bounding_box(&self) -> (DVec3, DVec3) {
        join::bounding_box(&self.surfaces)
    }

    fn shader(&self) -> &'static str {
        let is_cubic = self
            .surfaces
            .iter()
            .all(|surface| surface.degree().iter().all(|&degree| degree <= 3));
        match self.kind {
            PatchKind::Bezier if is_cubic => "surfaces/bezier_cubic.wgsl",
            PatchKind::Bezier => "surfaces/bezier.wgsl",
            PatchKind::Nurbs(BasisMethod::Triangular) if is_cubic => "surfaces/nurbs_cubic.wgsl",
            PatchKind::Nurbs(BasisMethod::Triangular | BasisMethod::Loops) => "surfaces/nurbs.wgsl",
            PatchKind::Nurbs(BasisMethod::Stair) => "surfaces/nurbs_stair.wgsl",
            PatchKind::Nurbs(BasisMethod::DeBoor) => "surfaces/nurbs_de_boor.wgsl",
            PatchKind::Nurbs(BasisMethod::Extraction) => "surfaces/nurbs_extraction.wgsl",
            PatchKind::Nurbs(BasisMethod::Power) => "surfaces/nurbs_power.wgsl",
        }
    }

    fn as_patches(&self) -> Option<&Patches> {
        Some(self)
    }

    fn tables(&self, origin: DVec3) -> SurfaceTables {
        tables::tables(self, origin)
    }

    fn own_coord(&self, surface: u32, s: f64, t: f64) -> Result<OwnCoord, ParameterError> {
        let Some(layout) = self.layouts.get(surface as usize) else {
            let surfaces = self.layouts.len() as u32;
            return Err(ParameterError::Surface { surface, surfaces });
        };
        let transposed = self.transposed[surface as usize];
        let exchange = |[a, b]: [f64; 2]| if transposed { [b, a] } else { [a, b] };
        let [u, v] = exchange([s, t]);
        let [Some(i), Some(j)] = [span::find(&layout.spans[0], u), span::find(&layout.spans[1], v)] else {
            let mut domain = self.surfaces[surface as usize].domain();
            if transposed {
                domain.reverse();
            }
            return Err(ParameterError::OutsideSurface { surface, s, t, domain });
        };
        let spans = [&layout.spans[0][i], &layout.spans[1][j]];
        let face = layout.face([i, j]);
        Ok(OwnCoord {
            at: self.face_coord(face, spans[0].fraction(u).f, spans[1].fraction(v).f)?,
            rates: exchange(spans.map(|span| 1.0 / span.length())),
            transposed,
        })
    }
}

fn fractions(at: RootPoint) -> [Fraction; 2] {
    QuadCoord::of(at).to_f64().map(Fraction::new)
}

#[cfg(test)]
mod derivative_tests;
