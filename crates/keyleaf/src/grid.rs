//! The base grid: the triangles that are instanced for every leaf.

use wgpu::util::DeviceExt;

/// Vertices (i, j), i + j <= 2^k, of the grid of 4^k triangles in a leaf's unit right triangle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BaseGrid {
    /// i | j << 16, row by row.
    pub vertices: Vec<u32>,
    /// Three a triangle, wound as the leaf is.
    pub indices: Vec<u16>,
}

impl BaseGrid {
    /// The grid of a given k, 0..=6.
    pub fn new(k: u32) -> Self {
        let n = 1u32 << k;
        let mut vertices = Vec::new();
        let mut row_starts = Vec::new();
        for j in 0..=n {
            row_starts.push(vertices.len() as u16);
            vertices.extend((0..=n - j).map(|i| i | (j << 16)));
        }
        let at = |i: u32, j: u32| row_starts[j as usize] + i as u16;
        let mut indices = Vec::new();
        for j in 0..n {
            for i in 0..n - j {
                indices.extend([at(i, j), at(i + 1, j), at(i, j + 1)]);
                if i + j + 1 < n {
                    indices.extend([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
            }
        }
        Self { vertices, indices }
    }
}

/// The base grid on the GPU.
#[derive(Debug)]
pub(crate) struct GridBuffers {
    pub k: u32,
    pub vertices: wgpu::Buffer,
    pub indices: wgpu::Buffer,
}

impl GridBuffers {
    pub fn new(device: &wgpu::Device, k: u32) -> Self {
        let grid = BaseGrid::new(k);
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
            k,
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_four_to_the_k_triangles_of_equal_area_and_winding() {
        for k in 0..=6 {
            let grid = BaseGrid::new(k);
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
