//! The base grid: the triangles that are instanced for every leaf.

use crate::Settings;
use crate::settings::Morph;
use keyleaf_key::{MAX_LEVEL, Place};
use wgpu::util::DeviceExt;

/// Vertices (i, j), i + j <= 2^k, of the grid of 4^k triangles in a leaf's unit right triangle.
///
/// Hypotenuses are parallel to the leaf's, as bounds of the deviation have it; where vertices [morph](Morph), the triangles are those into
/// which the leaf would be split, so that every edge of a grid is divided by a vertex of the next.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BaseGrid {
    /// i | j << 16, row by row.
    pub vertices: Vec<u32>,
    /// Three a triangle, wound as the leaf is.
    pub indices: Vec<u16>,
}

impl BaseGrid {
    /// The grid that leaves are drawn with.
    pub fn of(settings: &Settings) -> Self {
        let k = settings.base_grid;
        match settings.morph {
            Morph::None => Self::with_triangles(k, &parallel(k)),
            Morph::Geomorph => Self::with_triangles(k, &split(k)),
        }
    }

    fn with_triangles(k: u32, triangles: &[[[u32; 2]; 3]]) -> Self {
        let n = 1u32 << k;
        let mut vertices = Vec::new();
        let mut row_starts = Vec::new();
        for j in 0..=n {
            row_starts.push(vertices.len() as u16);
            vertices.extend((0..=n - j).map(|i| i | (j << 16)));
        }
        let corners = triangles.iter().flatten();
        let indices = corners.map(|[i, j]| row_starts[*j as usize] + *i as u16).collect();
        Self { vertices, indices }
    }
}

/// Corners of triangles whose hypotenuses are parallel, row by row.
fn parallel(k: u32) -> Vec<[[u32; 2]; 3]> {
    let n = 1u32 << k;
    let mut triangles = Vec::new();
    for j in 0..n {
        for i in 0..n - j {
            triangles.push([[i, j], [i + 1, j], [i, j + 1]]);
            if i + j + 1 < n {
                triangles.push([[i + 1, j], [i + 1, j + 1], [i, j + 1]]);
            }
        }
    }
    triangles
}

/// Corners of the descendants k levels below a node.
fn split(k: u32) -> Vec<[[u32; 2]; 3]> {
    let mut nodes = vec![Place::of_root(0, 0)];
    for _ in 0..k {
        nodes = nodes.into_iter().flat_map(Place::children).collect();
    }
    let shift = MAX_LEVEL - k;
    let corners = |node: &Place| node.corners().map(|corner| [corner.x >> shift, corner.y >> shift]);
    nodes.iter().map(corners).collect()
}

/// The base grid on the GPU.
#[derive(Debug)]
pub(crate) struct GridBuffers {
    kind: (u32, Morph),
    pub vertices: wgpu::Buffer,
    pub indices: wgpu::Buffer,
}

impl GridBuffers {
    pub fn new(device: &wgpu::Device, settings: &Settings) -> Self {
        let grid = BaseGrid::of(settings);
        let mut indices = grid.indices;
        indices.resize(indices.len().next_multiple_of(2), 0); // buffers are multiples of 4 bytes
        let make = |label, contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents,
                usage,
            })
        };
        Self {
            kind: (settings.base_grid, settings.morph),
            vertices: make(
                "keyleaf.grid.vertices",
                bytemuck::cast_slice(&grid.vertices),
                wgpu::BufferUsages::VERTEX,
            ),
            indices: make(
                "keyleaf.grid.indices",
                bytemuck::cast_slice(&indices),
                wgpu::BufferUsages::INDEX,
            ),
        }
    }

    /// Whether leaves with these settings are drawn with it.
    pub fn is_of(&self, settings: &Settings) -> bool {
        self.kind == (settings.base_grid, settings.morph)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_four_to_the_k_triangles_of_equal_area_and_winding() {
        for (base_grid, morph) in (0..=6).flat_map(|k| Morph::ALL.map(|morph| (k, morph))) {
            let settings = Settings {
                base_grid,
                morph,
                ..Settings::default()
            };
            let (k, grid) = (base_grid, BaseGrid::of(&settings));
            assert_eq!(grid.indices.len(), 3 << (2 * k));
            for triangle in grid.indices.chunks(3) {
                let p = |v: u16| {
                    (
                        i64::from(grid.vertices[v as usize] & 0xffff),
                        i64::from(grid.vertices[v as usize] >> 16),
                    )
                };
                let [a, b, c] = [p(triangle[0]), p(triangle[1]), p(triangle[2])];
                assert_eq!((b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0), 1);
            }
        }
    }
}
