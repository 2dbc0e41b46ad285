//! What no mesh and no motion can be made of.

use drape_collide::{Error, ProximityMesh, earliest_impact, earliest_self_impact};

const CORNERS: [[f64; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

#[test]
fn meshes_with_missing_vertices_or_bad_positions_are_refused() {
    let refused = |positions: &[[f64; 3]], triangles: &[[u32; 3]], edges: &[[u32; 2]]| {
        ProximityMesh::with_edges(positions, triangles, edges).unwrap_err()
    };
    assert!(matches!(refused(&[], &[], &[]), Error::NoVertices));
    let error = refused(&CORNERS, &[[0, 1, 3]], &[]);
    assert!(matches!(error, Error::MissingVertex { index: 3, .. }), "{error}");
    let error = refused(&CORNERS, &[[0, 1, 1]], &[]);
    assert!(matches!(error, Error::RepeatedVertex { .. }), "{error}");
    for edge in [[0, 3], [1, 1], [u32::MAX, 0]] {
        let error = refused(&CORNERS, &[], &[[0, 1], edge]);
        assert!(matches!(error, Error::InvalidEdge { edge: 1, .. }), "{error}");
    }
    for bad in [f64::NAN, f64::INFINITY, 1.1e6] {
        let mut positions = CORNERS;
        positions[2][1] = bad;
        let error = refused(&positions, &[[0, 1, 2]], &[]);
        assert!(matches!(error, Error::InvalidPosition { .. }), "{error}");
    }
}

#[test]
fn motions_of_other_lengths_and_bad_tolerances_are_refused() {
    let mut mesh = ProximityMesh::new(&CORNERS, &[[0, 1, 2]]).unwrap();
    let error = mesh.moving_to(&CORNERS[..2]).unwrap_err();
    assert!(matches!(error, Error::WrongLength { found: 2, needed: 3, .. }), "{error}");
    let error = mesh.move_to(&[[f64::NAN; 3]; 3]).unwrap_err();
    assert!(matches!(error, Error::InvalidPosition { .. }), "{error}");
    assert_eq!(mesh.positions(), CORNERS);
    for tolerance in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        let (one, two) = (mesh.at_rest(), mesh.at_rest());
        let error = earliest_impact(&one, &two, tolerance).unwrap_err();
        assert!(matches!(error, Error::OutOfRange { .. }), "{error}");
        assert!(earliest_self_impact(&one, tolerance).is_err());
    }
}
