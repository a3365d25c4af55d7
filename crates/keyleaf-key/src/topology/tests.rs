//! Adjacency of meshes that are surfaces, and the error of each kind that is not.

use super::*;
use TopologyError::*;

fn error_of(vertex_count: usize, faces: &[&[u32]]) -> TopologyError {
    Topology::new(vertex_count, faces).expect_err("not a surface")
}

#[test]
fn mixed_polygons_find_their_twins_owners_and_boundaries() -> Result<(), TopologyError> {
    // A quad, a triangle on its right edge, a pentagon on top.
    let mesh = Topology::new(8, [&[0, 1, 2, 3][..], &[1, 4, 2], &[3, 2, 5, 6, 7]])?;
    assert_eq!(
        (mesh.face_count(), mesh.half_edge_count(), mesh.vertex_count()),
        (3, 12, 8)
    );
    assert_eq!([0, 1, 2].map(|face| mesh.corner_count(face)), [4, 3, 5]);
    assert_eq!([0, 1, 2].map(|face| mesh.first_half_edge(face)), [0, 4, 7]);
    assert_eq!(mesh.vertex(2, 4), 7);
    assert_eq!(mesh.twin(0, 1), Some(HalfEdge { face: 1, root: 2 }));
    assert_eq!(mesh.twin(0, 2), Some(HalfEdge { face: 2, root: 0 }));
    assert_eq!(mesh.twin(0, 0), None);
    assert_eq!(mesh.half_edge_owner(2, 0), HalfEdge { face: 0, root: 2 });
    assert_eq!(mesh.half_edge_owner(2, 1), HalfEdge { face: 2, root: 1 });
    assert_eq!(mesh.vertex_owner(2), Some(HalfEdge { face: 0, root: 2 }));
    assert!(mesh.has_root(2, 4) && !mesh.has_root(2, 5) && !mesh.has_root(3, 0));
    assert_eq!(mesh.roots().count(), 12);
    Ok(())
}

#[test]
fn gpu_words_are_counts_first_half_edges_and_twins() -> Result<(), TopologyError> {
    let mesh = Topology::new(4, [[0, 1, 2], [2, 1, 3]])?;
    let none = u32::MAX;
    let twins = [none, none, 1, 0, none, none, 0, 1, none, none, none, none];
    assert_eq!(mesh.gpu_words(), [&[2, 6, 0, 3, 6][..], &twins].concat());
    Ok(())
}

#[test]
fn unused_vertices_touching_corners_and_faces_back_to_back_are_fine() -> Result<(), TopologyError> {
    let touching = Topology::new(9, [[0, 1, 2], [2, 3, 4]])?;
    assert_eq!(touching.vertex_owner(8), None);
    let pillow = Topology::new(4, [[0, 1, 2, 3], [3, 2, 1, 0]])?;
    assert!((0..4).all(|root| pillow.twin(0, root).is_some()));
    Ok(())
}

#[test]
fn malformed_faces_are_named() {
    assert_eq!(error_of(3, &[]), Empty);
    assert_eq!(
        error_of(3, &[&[0, 1, 2], &[0, 1]]),
        TooFewCorners { face: 1, corners: 2 }
    );
    assert_eq!(
        error_of(3, &[&[0, 1, 2], &[2, 1, 3]]),
        IndexOutOfRange {
            face: 1,
            corner: 2,
            vertex: 3,
            vertex_count: 3
        }
    );
    assert_eq!(
        error_of(4, &[&[0, 1, 2, 1]]),
        RepeatedIndex {
            face: 0,
            corners: [1, 3],
            vertex: 1
        }
    );
    let huge: Vec<u32> = (0..65_536).collect();
    assert_eq!(
        error_of(65_536, &[&huge]),
        TooManyCorners {
            face: 0,
            corners: 65_536
        }
    );
    assert!(Topology::new(65_536, [&huge[1..]]).is_ok());
}

#[test]
fn faces_that_form_no_oriented_surface_are_named() {
    assert_eq!(
        error_of(5, &[&[0, 1, 2], &[1, 0, 3], &[1, 0, 4]]),
        NonManifoldEdge {
            vertices: [0, 1],
            faces: vec![0, 1, 2]
        }
    );
    assert_eq!(
        error_of(4, &[&[0, 1, 2], &[0, 1, 3]]),
        InconsistentWinding {
            vertices: [0, 1],
            faces: [0, 1]
        }
    );
    assert_eq!(
        error_of(4, &[&[0, 1, 2, 3], &[2, 3, 0, 1]]),
        DuplicateFace { faces: [0, 1] }
    );
    // A duplicate is called so also where its neighbours make the edge one of three faces.
    assert_eq!(
        error_of(4, &[&[0, 1, 2], &[1, 0, 3], &[1, 2, 0]]),
        DuplicateFace { faces: [0, 2] }
    );
}

#[test]
fn messages_say_what_where_and_stay_one_line() {
    let fan: Vec<[u32; 3]> = (0..100).map(|i| [0, 1, i + 2]).collect();
    let message = Topology::new(102, fan).expect_err("non-manifold").to_string();
    assert_eq!(
        message,
        "the edge between vertices 0 and 1 is used by 100 faces (0, 1, 2, 3, 4, 5, 6, 7, …); a surface has at most 2 at an edge"
    );
}

/// The pairs of a topology, each once.
fn pairs_of(mesh: &Topology) -> Vec<[HalfEdge; 2]> {
    mesh.roots()
        .map(|root| HalfEdge {
            face: root.face,
            root: root.root,
        })
        .filter_map(|own| mesh.twin(own.face, own.root).map(|twin| [own, twin]))
        .filter(|[own, twin]| own < twin)
        .collect()
}

#[test]
fn gluing_gives_the_topology_of_the_same_mesh_by_vertices() -> Result<(), TopologyError> {
    let meshes: [&[&[u32]]; 3] = [
        &[&[0, 1, 2, 3], &[1, 4, 2], &[3, 2, 5, 6, 7]],
        &[&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]],
        &[
            &[0, 1, 3, 2],
            &[4, 6, 7, 5],
            &[0, 4, 5, 1],
            &[2, 3, 7, 6],
            &[0, 2, 6, 4],
            &[1, 5, 7, 3],
        ],
    ];
    for faces in meshes {
        let by_vertices = Topology::new(8, faces)?;
        let counts = faces.iter().map(|face| face.len() as u32);
        let glued = Topology::glued(counts, pairs_of(&by_vertices))?;
        assert_eq!(glued.gpu_words(), by_vertices.gpu_words());
        for root in glued.roots() {
            let owner = |mesh: &Topology| mesh.vertex_owner(mesh.vertex(root.face, root.root));
            assert_eq!(owner(&glued), owner(&by_vertices));
        }
    }
    Ok(())
}

#[test]
fn faces_may_meet_themselves() -> Result<(), TopologyError> {
    let side = |face, root| HalfEdge { face, root };
    let torus = Topology::glued([4], [[side(0, 0), side(0, 2)], [side(0, 1), side(0, 3)]])?;
    assert_eq!(torus.vertices(0), [0; 4]);
    assert_eq!(torus.half_edge_owner(0, 2), side(0, 0));
    // A sphere of one strip: two quads side by side, closed round, and its ends folded shut.
    let strip = [
        [side(0, 1), side(1, 3)],
        [side(1, 1), side(0, 3)],
        [side(0, 0), side(1, 0)],
        [side(0, 2), side(1, 2)],
    ];
    let sphere = Topology::glued([4, 4], strip)?;
    assert_eq!(sphere.vertex_count(), 4);
    assert_eq!(sphere.vertices(0), [0, 1, 2, 3]);
    assert_eq!(sphere.vertices(1), [1, 0, 3, 2]);
    Ok(())
}

#[test]
fn a_torus_of_one_quad_refines_without_cracks() -> Result<(), TopologyError> {
    let side = |root| HalfEdge { face: 0, root };
    let torus = Topology::glued([4], [[side(0), side(2)], [side(1), side(3)]])?;
    let mut forest = crate::Forest::new(&torus, 6);
    for pass in 0..24 {
        forest.update(
            |leaf| {
                let near = leaf.x.max(leaf.y) >= crate::ONE / 4 * 3;
                if leaf.level < if near { 6 } else { 2 } {
                    2.0
                } else {
                    0.4
                }
            },
            usize::MAX,
        );
        assert!(forest.invariants().is_empty());
        // Drawn edges are told apart by their ends, which are all one vertex before the first splits.
        assert!(pass < 2 || forest.cracks().is_empty());
    }
    assert!(forest.leaves.keys().any(|leaf| leaf.level == 6));
    Ok(())
}

#[test]
fn pairs_that_glue_nothing_are_named() {
    let side = |face, root| HalfEdge { face, root };
    let error = |counts: &[u32], pairs: &[[HalfEdge; 2]]| {
        Topology::glued(counts.iter().copied(), pairs.iter().copied()).expect_err("no surface")
    };
    assert_eq!(error(&[], &[]), Empty);
    assert_eq!(error(&[4, 2], &[]), TooFewCorners { face: 1, corners: 2 });
    assert_eq!(
        error(&[65_536], &[]),
        TooManyCorners {
            face: 0,
            corners: 65_536
        }
    );
    assert_eq!(error(&[65_535; 16_386], &[]), TooManyHalfEdges { face: 16_384 });
    assert_eq!(
        error(&[4, 3], &[[side(0, 3), side(1, 3)]]),
        NoSuchHalfEdge { face: 1, root: 3 }
    );
    assert_eq!(
        error(&[4], &[[side(1, 0), side(0, 0)]]),
        NoSuchHalfEdge { face: 1, root: 0 }
    );
    assert_eq!(
        error(&[4], &[[side(0, 2), side(0, 2)]]),
        PairedWithItself { face: 0, root: 2 }
    );
    assert_eq!(
        error(&[4, 4], &[[side(0, 0), side(1, 0)], [side(1, 1), side(0, 0)]]),
        PairedTwice { face: 0, root: 0 }
    );
}
