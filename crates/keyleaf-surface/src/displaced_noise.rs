//! Meshes displaced by fractal noise. Twin of `shaders/surfaces/displaced_noise.wgsl`.

use crate::direction::round_up;
use crate::displaced::{DisplacementBound, SmoothMesh};
use crate::noise::{NOISE3_LARGEST, NOISE3_SLOPE, noise3, octave_seed};
use crate::surface::uniform;
use crate::{MeshError, PolygonMesh, SettingError, Surface, SurfaceBound, SurfaceFrame, SurfaceTables, diamond};
use encase::ShaderType;
use glam::{DVec3, IVec3, UVec3};
use keyleaf_key::{Place, RootPoint, Topology};

/// Gradient noise summed over octaves that double in frequency (fBm). Numbers are rounded to f32, which the GPU computes with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseDisplacement {
    /// Of the first octave, object units. One octave lies within ±1.5 times this, seldom beyond ±0.7.
    pub amplitude: f64,
    /// Cells of the first octave a unit of length.
    pub frequency: f64,
    /// 1 to 16.
    pub octaves: u32,
    /// The amplitude of an octave over that of the one before, 0 to 1.
    pub gain: f64,
    /// Another seed, other noise.
    pub seed: u32,
}

impl Default for NoiseDisplacement {
    fn default() -> Self {
        Self {
            amplitude: 0.1,
            frequency: 2.0,
            octaves: 6,
            gain: 0.5,
            seed: 0,
        }
    }
}

impl NoiseDisplacement {
    fn check(&self) -> Result<(), SettingError> {
        SettingError::check(
            "amplitude",
            self.amplitude,
            self.amplitude.abs() <= 1e15,
            "a length of at most 1e15",
        )?;
        SettingError::check(
            "frequency",
            self.frequency,
            (1e-15..=1e15).contains(&self.frequency),
            "a number greater than 0",
        )?;
        SettingError::check(
            "octaves",
            f64::from(self.octaves),
            (1..=16).contains(&self.octaves),
            "1 to 16",
        )?;
        SettingError::check(
            "gain",
            self.gain,
            (0.0..=1.0).contains(&self.gain),
            "a number from 0 to 1",
        )
    }

    /// (frequency, amplitude) of every octave.
    fn octaves(&self) -> impl Iterator<Item = (f64, f64)> {
        let next = |&(frequency, amplitude): &(f64, f64)| Some((frequency * 2.0, amplitude * self.gain));
        std::iter::successors(Some((self.frequency, self.amplitude)), next).take(self.octaves as usize)
    }

    fn value(&self, point: DVec3) -> (f64, DVec3) {
        let (mut value, mut gradient) = (0.0, DVec3::ZERO);
        for (octave, (frequency, amplitude)) in (0..).zip(self.octaves()) {
            let at = point * frequency;
            let cell = at.floor().to_array().map(|c| c as i64 as u32);
            let [n, x, y, z] = noise3(cell, (at - at.floor()).to_array(), octave_seed(self.seed, octave));
            value += amplitude * n;
            gradient += amplitude * frequency * DVec3::new(x, y, z);
        }
        (value, gradient)
    }

    fn largest(&self) -> f64 {
        self.octaves()
            .map(|(_, amplitude)| NOISE3_LARGEST * amplitude.abs())
            .sum()
    }

    /// The greatest slopes of the octaves.
    fn slopes(&self) -> impl Iterator<Item = f64> {
        self.octaves()
            .map(|(frequency, amplitude)| NOISE3_SLOPE * frequency * amplitude.abs())
    }

    /// The octaves' greatest slopes added as squares, since they are independent: about three standard deviations of the slope.
    fn typical_slope(&self) -> f64 {
        self.slopes().map(|slope| slope * slope).sum::<f64>().sqrt()
    }
}

/// A mesh displaced along its smooth normals by noise of the position on the flat mesh.
///
/// [`SurfaceBound::size`] counts a typical steep slope of the noise, not the steepest that is possible, which hardly occurs and
/// would refine everything else too far; the radius for culling holds for the steepest.
///
/// GPU memory: 32 bytes a vertex, 48 a face, 16 a corner.
#[derive(Clone, Debug)]
pub struct DisplacedNoise {
    mesh: SmoothMesh,
    noise: NoiseDisplacement,
}

#[derive(ShaderType)]
struct DisplacedNoiseParams {
    vertices: u32,
    faces: u32,
    margin: f32,
    octaves: u32,
    origin_cell: IVec3,
    seed: u32,
    origin_rest: UVec3,
    frequency: f32,
    amplitude: f32,
    gain: f32,
    largest: f32,
    typical_slope: f32,
}

impl DisplacedNoise {
    /// The surface of a mesh with this noise.
    ///
    /// # Errors
    /// [`MeshError`] if the mesh is no surface, a setting is out of range, or the last octave has more than 2³⁰ cells over the mesh.
    pub fn new(mesh: &PolygonMesh, noise: NoiseDisplacement) -> Result<Self, MeshError> {
        noise.check()?;
        let round = |value: f64| f64::from(value as f32);
        let noise = NoiseDisplacement {
            amplitude: round(noise.amplitude),
            frequency: round(noise.frequency),
            gain: round(noise.gain),
            ..noise
        };
        let mesh = SmoothMesh::new(mesh)?;
        let (low, high) = mesh.polygons.bounding_box();
        let finest = noise.frequency * f64::from(1u32 << (noise.octaves - 1)) * (high - low).max_element();
        let expected = "so few octaves of so low a frequency that fewer than 2^30 cells cover the mesh";
        SettingError::check("frequency", noise.frequency, finest < f64::from(1 << 30), expected)?;
        Ok(Self { mesh, noise })
    }

    fn displacement_bound(&self, leaf: &Place) -> DisplacementBound {
        let root = self.topology().half_edge_index(leaf.face, leaf.root) as usize;
        let speed = self.mesh.polygons.speeds[root];
        let reach = speed * diamond::ball_scale(leaf.level);
        // The typical slope counts as if it were at right angles to the flat mesh.
        let smooth_speed = speed + self.noise.largest() * self.mesh.normal_speeds[root];
        let typical = smooth_speed.hypot(self.noise.typical_slope() * speed) - smooth_speed;
        let ranges = self
            .noise
            .octaves()
            .map(|(_, amplitude)| 2.0 * NOISE3_LARGEST * amplitude.abs());
        DisplacementBound {
            largest: self.noise.largest(),
            variation: self
                .noise
                .slopes()
                .zip(ranges)
                .map(|(slope, range)| range.min(slope * reach))
                .sum(),
            steepest: self.noise.slopes().sum::<f64>() * reach,
            typical: typical * diamond::level_scale(leaf.level),
            jump: 0.0,
        }
    }
}

impl Surface for DisplacedNoise {
    fn topology(&self) -> &Topology {
        &self.mesh.polygons.topology
    }

    fn point(&self, at: RootPoint) -> DVec3 {
        self.mesh.point(at, self.noise.value(self.mesh.base(at)).0)
    }

    fn frame(&self, at: RootPoint) -> SurfaceFrame {
        let h = self.noise.value(self.mesh.base(at)).0;
        self.mesh.frame(at, h, |_, base, du, dv| {
            let (h, gradient) = self.noise.value(base);
            [h, gradient.dot(du), gradient.dot(dv)]
        })
    }

    fn bound(&self, leaf: &Place) -> SurfaceBound {
        self.mesh
            .bound(leaf, self.point(diamond::centre(leaf)), self.displacement_bound(leaf))
    }

    fn bounding_box(&self) -> (DVec3, DVec3) {
        self.mesh.bounding_box(self.noise.largest())
    }

    fn shader(&self) -> &'static str {
        "surfaces/displaced_noise.wgsl"
    }

    fn tables(&self, origin: DVec3) -> SurfaceTables {
        let polygons = &self.mesh.polygons;
        let cells = origin * self.noise.frequency;
        let rest = ((cells - cells.floor()) * 2f64.powi(32)).to_array().map(|c| c as u32);
        let cell = cells.floor().to_array().map(|c| c as i64 as i32);
        let slope = self.noise.slopes().sum();
        let params = DisplacedNoiseParams {
            vertices: polygons.vertex_count(),
            faces: polygons.topology.face_count(),
            margin: round_up(self.mesh.margin(origin, self.noise.largest(), slope)),
            octaves: self.noise.octaves,
            origin_cell: IVec3::from_array(cell),
            seed: self.noise.seed,
            origin_rest: UVec3::from_array(rest),
            frequency: self.noise.frequency as f32,
            amplitude: self.noise.amplitude as f32,
            gain: self.noise.gain as f32,
            largest: round_up(self.noise.largest()),
            typical_slope: round_up(self.noise.typical_slope()),
        };
        let roots = polygons
            .vertices
            .iter()
            .zip(&polygons.speeds)
            .zip(&self.mesh.normal_speeds);
        SurfaceTables {
            params: uniform(&params),
            a: self.mesh.table(origin),
            b: roots
                .flat_map(|((&v, &p), &n)| [v, round_up(p).to_bits(), round_up(n).to_bits(), 0])
                .collect(),
            heights: None,
            height_bounds: None,
        }
    }
}
