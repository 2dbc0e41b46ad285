//! Scenes and views that must be refused, and degenerate ones that must not be.

#![allow(clippy::unwrap_used)]

use drape_render::{Error, Extent, LitShapes, Scene, Surface, View, render};

const SMALL: View =
    View { azimuth_deg: 25.0, elevation_deg: 30.0, field_deg: 24.0, width: 160, height: 120 };

type Shape = (Vec<f64>, Vec<[u32; 3]>);

/// A level square of nine vertices with its material coordinates.
fn square() -> (Shape, Vec<f64>) {
    let places = (0..9).map(|k| [f64::from(k % 3), f64::from(k / 3)]);
    let positions = places.clone().flat_map(|[x, z]| [x, 0.0, z]).collect();
    let cells = [0, 1, 3, 4].map(|a| [[a, a + 3, a + 4], [a, a + 4, a + 1]]);
    let triangles = cells.as_flattened().to_vec();
    ((positions, triangles), places.flatten().collect())
}

fn cloth(shape: &Shape) -> Surface<'_> {
    Surface::cloth(&shape.0, &shape.1)
}

#[test]
fn invalid_scenes_and_views_are_refused() {
    let (shape, coordinates) = square();
    let refused = |scene: &Scene, view: &View| render(scene, view).expect_err("refused");
    let only = |surface: Surface<'_>| -> Error {
        let scene = Scene { cloths: vec![surface], ..Scene::default() };
        refused(&scene, &SMALL)
    };
    assert_eq!(refused(&Scene::default(), &SMALL), Error::EmptyScene);
    assert_eq!(only(Surface::cloth(&shape.0, &[])), Error::EmptyScene);
    for bad in [f64::NAN, f64::INFINITY, 1e9] {
        let mut lost = shape.clone();
        lost.0[7] = bad;
        let error = only(cloth(&lost));
        let named = matches!(&error, Error::BadCoordinate { vertex: 2, .. });
        assert!(named, "{error}");
        let mut lost = coordinates.clone();
        lost[3] = bad;
        let error = only(cloth(&shape).with_lines(&lost, 0.1));
        let named = matches!(&error, Error::BadCoordinate { vertex: 1, .. });
        assert!(named, "{error}");
    }
    let error = only(Surface::cloth(&shape.0, &[[0, 1, 9]]));
    assert!(matches!(error, Error::NoSuchVertex { index: 9, .. }), "{error}");
    let error = only(Surface::cloth(&shape.0[1..], &shape.1));
    assert!(matches!(error, Error::BadLength { length: 26, .. }), "{error}");
    let error = only(cloth(&shape).with_lines(&coordinates[2..], 0.1));
    assert!(matches!(error, Error::BadLength { length: 16, .. }), "{error}");
    let error = only(cloth(&shape).with_sides(&[[[200; 3]; 2]; 7]));
    assert!(matches!(error, Error::BadLength { length: 7, .. }), "{error}");
    let error = only(cloth(&shape).with_lines(&coordinates, 0.0));
    assert!(matches!(error, Error::OutOfRange { .. }), "{error}");

    let scene = Scene { cloths: vec![cloth(&shape)], ..Scene::default() };
    let views = [
        View { width: 0, ..SMALL },
        View { height: 1 << 20, ..SMALL },
        View { azimuth_deg: f64::NAN, ..SMALL },
        View { elevation_deg: 91.0, ..SMALL },
        View { field_deg: 0.0, ..SMALL },
    ];
    for view in views {
        let error = refused(&scene, &view);
        assert!(matches!(error, Error::OutOfRange { .. }), "{error}");
    }
    let biased = Scene { body_depth_bias: -1.0, ..scene.clone() };
    let error = refused(&biased, &SMALL);
    assert!(matches!(error, Error::OutOfRange { .. }), "{error}");
    let shapes = LitShapes::new(&scene).unwrap();
    let other = Scene { cloths: vec![Surface::cloth(&shape.0, &shape.1[1..])], ..Scene::default() };
    let error = shapes.draw(&other, &SMALL.camera(&scene).unwrap()).expect_err("other shapes");
    assert_eq!(error, Error::OtherShapes);
    assert_eq!(View::cameras(&[SMALL], &Extent::default()).expect_err("none"), Error::EmptyScene);
    let picture = render(&scene, &SMALL).unwrap();
    let error = picture.save("no/such/folder/picture.png").expect_err("nowhere");
    assert!(error.to_string().contains("no/such/folder"), "{error}");
}

#[test]
fn a_cloth_of_one_point_or_no_area_does_not_panic() {
    let scene = |positions: &'static [f64]| Scene {
        cloths: vec![Surface::cloth(positions, &[[0, 1, 2]])],
        floor: Some(0.0),
        ..Scene::default()
    };
    for positions in [&[1.0; 9], &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0]] {
        let picture = render(&scene(positions), &SMALL).unwrap();
        assert_eq!((picture.width(), picture.height()), (160, 120));
    }
}
