//! Pictures, read back.

#![allow(clippy::unwrap_used)]

use drape_render::{Extent, Ground, LitShapes, Picture, Scene, ScreenPoint, Surface, View, render};
use std::f64::consts::{PI, TAU};

type Shape = (Vec<f64>, Vec<[u32; 3]>);

const SMALL: View =
    View { azimuth_deg: 25.0, elevation_deg: 30.0, field_deg: 24.0, width: 400, height: 300 };

fn sphere(radius: f64, center: [f64; 3]) -> Shape {
    let (around, down) = (128, 64);
    let mut positions = Vec::new();
    for j in 0..=down {
        let (ring, height) = (PI * f64::from(j) / f64::from(down)).sin_cos();
        for i in 0..around {
            let (sine, cosine) = (TAU * f64::from(i) / f64::from(around)).sin_cos();
            let direction = [ring * sine, height, ring * cosine];
            positions.extend([0, 1, 2].map(|k| center[k] + radius * direction[k]));
        }
    }
    let mut triangles = Vec::new();
    for j in 0..down as u32 {
        for i in 0..around as u32 {
            let (a, b) = (j * 128 + i, j * 128 + (i + 1) % 128);
            triangles.extend([[a, a + 128, b + 128], [a, b + 128, b]]);
        }
    }
    (positions, triangles)
}

/// A level square of half the side `half` at a height, with its front up, cut into cells.
fn square(half: f64, height: f64, cells: u32) -> (Shape, Vec<f64>) {
    let (mut positions, mut coordinates, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..=cells {
        for i in 0..=cells {
            let [x, z] = [i, j].map(|k| half * (2.0 * f64::from(k) / f64::from(cells) - 1.0));
            positions.extend([x, height, z]);
            coordinates.extend([x + half, z + half]);
            if i < cells && j < cells {
                let a = j * (cells + 1) + i;
                let b = a + cells + 1;
                triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
            }
        }
    }
    ((positions, triangles), coordinates)
}

fn cloth(shape: &Shape) -> Surface<'_> {
    Surface::cloth(&shape.0, &shape.1)
}

fn count(picture: &Picture, which: impl Fn([u8; 3]) -> bool) -> usize {
    let (pixels, _) = picture.pixels().as_chunks::<3>();
    pixels.iter().filter(|pixel| which(**pixel)).count()
}

#[test]
fn the_silhouette_of_a_sphere_is_its_projected_disc() {
    let (radius, center) = (0.3, [1.0, 2.0, -1.0]);
    let shape = sphere(radius, center);
    let scene = Scene { bodies: vec![Surface::body(&shape.0, &shape.1)], ..Scene::default() };
    let view = View { field_deg: 50.0, width: 800, height: 600, ..SMALL };
    let camera = view.camera(&scene).unwrap();
    let eye = camera.eye();
    let away = [0, 1, 2].map(|k| eye[k] - center[k]);
    let distance = away.iter().map(|a| a * a).sum::<f64>().sqrt();
    // The tangent from the eye touches at the cosine R/D from the line of sight; go there sideways.
    let (cosine, level) = (radius / distance, away[0].hypot(away[2]));
    let sine = (1.0 - cosine * cosine).sqrt();
    let side = [away[2] / level, 0.0, -away[0] / level];
    let touch =
        [0, 1, 2].map(|k| center[k] + radius * (cosine * away[k] / distance + sine * side[k]));
    let [middle, rim] = [camera.project(center), camera.project(touch)];
    let disc = PI * (rim.x - middle.x).hypot(rim.y - middle.y).powi(2);
    let picture = render(&scene, &view).unwrap();
    // Pixels that are cut count by halves: those that show any grey less half of the rim.
    let grey = count(&picture, |pixel| pixel != [255; 3]) as f64;
    let rim_pixels = 4.0 * (disc / PI).sqrt();
    let measured = grey - rim_pixels;
    let miss = (measured / disc - 1.0).abs();
    assert!(miss < 0.01, "{measured} pixels, not {disc}");
}

#[test]
fn the_frame_holds_the_whole_cloth_and_little_else() {
    let (shape, _) = square(0.5, 1.0, 4);
    for azimuth_deg in [0.0, 77.0, 200.0] {
        for elevation_deg in [-90.0, -20.0, 0.0, 45.0, 90.0] {
            let view = View { azimuth_deg, elevation_deg, ..SMALL };
            let scene = Scene { cloths: vec![cloth(&shape)], ..Scene::default() };
            let camera = view.camera(&scene).unwrap();
            let mut fill: f64 = 0.0;
            for p in shape.0.chunks(3) {
                let ScreenPoint { x, y, depth } = camera.project([p[0], p[1], p[2]]);
                assert!(depth > 0.0);
                fill = fill.max((x / 200.0 - 1.0).abs()).max((y / 150.0 - 1.0).abs());
            }
            assert!((fill - 0.9).abs() < 1e-9, "{view:?} fills {fill}");
        }
    }
}

#[test]
fn views_that_are_compared_have_one_scale_and_one_height() {
    // A plate on edge, 0.2 m wide, 0.8 m high and 0.6 m deep: front and side differ in width.
    let place = |k: u32| {
        let [x, y, z] = [(0.2, k & 1), (0.8, k >> 1 & 1), (0.6, k >> 2)]
            .map(|(size, side)| size * (f64::from(side) - 0.5));
        [x, y + 1.0, z]
    };
    let positions: Vec<f64> = (0..8).flat_map(place).collect();
    let scene = Scene {
        cloths: vec![Surface::cloth(&positions, &[[0, 1, 2], [3, 4, 5], [5, 6, 7]])],
        ..Scene::default()
    };
    let view = |azimuth_deg| View { azimuth_deg, elevation_deg: 5.0, ..SMALL };
    let views = [0.0, 90.0, 180.0, 33.0].map(view);
    let cameras = View::cameras(&views, &Extent::of(&scene)).unwrap();
    let scales: Vec<f64> = cameras
        .iter()
        .map(|camera| {
            let ends = [0.9, 1.1].map(|y| camera.project([0.0, y, 0.0]));
            assert!((ends[0].x - 200.0).abs() < 1e-9, "off the middle: {ends:?}");
            ends[0].y - ends[1].y
        })
        .collect();
    let same = |scale: &f64| (scale / scales[0] - 1.0).abs() < 1e-12;
    assert!(scales.iter().all(same), "{scales:?}");
    // All corners are inside, and one is at the border.
    let all = cameras.iter().flat_map(|camera| (0..8).map(|k| camera.project(place(k))));
    let fill = all.fold(0.0, |fill: f64, ScreenPoint { x, y, .. }| {
        fill.max((x / 200.0 - 1.0).abs()).max((y / 150.0 - 1.0).abs())
    });
    assert!((0.88..=0.9 + 1e-9).contains(&fill), "{fill}");
}

#[test]
fn a_thin_cloth_has_a_rim_and_a_light_one_stands_out() {
    let (shape, _) = square(0.5, 1.0, 10);
    let mut white = cloth(&shape);
    (white.front, white.back) = ([255; 3], [255; 3]);
    let on = |ground, thickness| {
        let cloths = vec![Surface { thickness, ..white }];
        let scene = Scene { cloths, ground, ..Scene::default() };
        render(&scene, &View { elevation_deg: 8.0, azimuth_deg: 0.0, ..SMALL }).unwrap()
    };
    let grey = on(Ground::GREY, 0.0);
    let ground = grey.pixel(3, 3).unwrap();
    assert!(ground.iter().all(|channel| (200..230).contains(channel)), "{ground:?}");
    assert_ne!(grey.pixel(3, 296), Some(ground), "it passes into another colour");
    // A thick cloth covers more of the picture, below its front hem.
    let covered = |thickness| count(&on(Ground::WHITE, thickness), |pixel| pixel != [255; 3]);
    let [thin, thick] = [1e-4, 0.02].map(covered);
    assert!(thick > thin + 1000, "{thin} and {thick} pixels");
}

#[test]
fn the_nearer_surface_hides_the_farther() {
    let (low, _) = square(0.5, 0.0, 4);
    let (high, _) = square(0.2, 0.3, 4);
    let [mut red, mut green] = [cloth(&low), cloth(&high)];
    (red.front, green.front) = ([200, 0, 0], [0, 200, 0]);
    (red.back, green.back) = (red.front, green.front);
    let middle = |elevation_deg: f64, cloths: Vec<Surface>| {
        let scene = Scene { cloths, ..Scene::default() };
        let view = View { elevation_deg, ..SMALL };
        let [r, g, _] = render(&scene, &view).unwrap().pixel(200, 150).unwrap();
        if r > g { "red" } else { "green" }
    };
    for cloths in [vec![red, green], vec![green, red]] {
        assert_eq!(middle(80.0, cloths.clone()), "green");
        assert_eq!(middle(-80.0, cloths), "red");
    }
}

#[test]
fn a_ball_is_brighter_on_the_side_of_the_key_light() {
    let shape = sphere(0.3, [0.0; 3]);
    let scene = Scene { bodies: vec![Surface::body(&shape.0, &shape.1)], ..Scene::default() };
    let view = View { elevation_deg: 0.0, ..SMALL };
    let picture = render(&scene, &view).unwrap();
    // Sky and headlight do not tell left from right.
    let at = |x: u32| picture.pixel(x, 150).unwrap().iter().map(|c| u32::from(*c)).sum::<u32>();
    let sides: Vec<[u32; 2]> = (65..100).map(|away| [at(199 - away), at(200 + away)]).collect();
    let brighter = |[a, b]: &[u32; 2]| f64::from(*a.max(b)) > 1.15 * f64::from(*a.min(b));
    assert!(sides.iter().all(brighter), "{sides:?}");
}

#[test]
fn front_and_back_differ_and_so_do_warp_and_weft() {
    let (shape, coordinates) = square(0.5, 0.0, 20);
    let scene = |spacing: f64| Scene {
        cloths: vec![cloth(&shape).with_lines(&coordinates, spacing)],
        ..Scene::default()
    };
    let above = View { azimuth_deg: 0.0, elevation_deg: 90.0, ..SMALL };
    let below = View { elevation_deg: -90.0, ..above };
    let front = render(&scene(0.25), &above).unwrap();
    let back = render(&scene(0.25), &below).unwrap();
    // Off the lines, a quarter of a cell from the middle.
    let camera = above.camera(&scene(0.25)).unwrap();
    let at = |picture: &Picture, x: f64, z: f64| {
        let ScreenPoint { x, y, .. } = camera.project([x, 0.0, z]);
        picture.pixel(x as u32, y as u32).unwrap()
    };
    let [r, _, b] = at(&front, 0.1, 0.1);
    assert!(b > r, "the front is blue");
    let [r, _, b] = at(&back, 0.1, 0.1);
    assert!(r > b, "the back is sand");
    // A line where the weft coordinate is constant runs along the warp; x is along the weft.
    let [plain, warp, weft] = [at(&front, 0.1, 0.1), at(&front, 0.0, 0.1), at(&front, 0.1, 0.0)];
    let bright = |pixel: [u8; 3]| pixel.iter().map(|c| u32::from(*c)).sum::<u32>();
    assert!(bright(warp) < bright(plain) && bright(weft) < bright(plain));
    let blue = |pixel: [u8; 3]| f64::from(pixel[2]) / f64::from(pixel[0]);
    let [plain_blue, warp_blue, weft_blue] = [plain, warp, weft].map(blue);
    assert!(
        warp_blue > 1.03 * plain_blue && weft_blue < 0.9 * plain_blue,
        "warp {warp:?}, weft {weft:?}, plain {plain:?}"
    );
    // As many lines as fit: three inside in each direction, of one or two pixels, and the hem.
    let dark = count(&front, |p| p != [255; 3] && bright(p) < bright(plain) - 60);
    let side = 0.9 * 300.0;
    let (least, most) = (6.0 * side, 10.0 * side * 2.0);
    assert!((least..most).contains(&(dark as f64)), "{dark} dark pixels");
}

#[test]
fn a_hem_is_as_wide_as_a_line_however_large_its_facets_are() {
    let view = View { azimuth_deg: 0.0, elevation_deg: 90.0, width: 1200, height: 900, ..SMALL };
    for cells in [1, 20] {
        let (shape, _) = square(0.5, 0.0, cells);
        let scene = Scene { cloths: vec![cloth(&shape)], ..Scene::default() };
        let picture = render(&scene, &view).unwrap();
        let row = |x: u32| u32::from(picture.pixel(x, 433).unwrap()[1]);
        let plain = row(600);
        let edge = (0..600).find(|&x| row(x) < 255).unwrap();
        // 1.6 pixels that the hem covers by half.
        let dark = (edge..600).filter(|&x| row(x) + 8 < plain).count();
        assert!((1..=3).contains(&dark), "{cells} cells: {dark} pixels");
        assert!((edge + 4..600).all(|x| row(x).abs_diff(plain) <= 8), "{cells} cells");
    }
}

#[test]
fn lines_too_close_to_be_seen_leave_an_even_tone() {
    let (shape, coordinates) = square(0.5, 0.0, 20);
    let scene =
        Scene { cloths: vec![cloth(&shape).with_lines(&coordinates, 2e-3)], ..Scene::default() };
    let view = View { elevation_deg: 90.0, azimuth_deg: 0.0, ..SMALL };
    let picture = render(&scene, &view).unwrap();
    let greens: Vec<u8> = (150..250).map(|x| picture.pixel(x, 140).unwrap()[1]).collect();
    let (least, most) = (greens.iter().min().unwrap(), greens.iter().max().unwrap());
    assert!(most - least <= 2, "from {least} to {most}");
}

#[test]
fn a_depth_bias_hides_the_edge_that_dips_through_the_cloth() {
    let (lid, _) = square(0.5, 0.0, 4);
    let (table, _) = square(0.4, 2e-3, 4);
    let grey_pixels = |body_depth_bias: f64, bodies: Vec<Surface>| {
        let cloths = vec![cloth(&lid)];
        let scene = Scene { cloths, bodies, body_depth_bias, ..Scene::default() };
        let grey = |p: [u8; 3]| p != [255; 3] && p[0].abs_diff(p[2]) < 6;
        count(&render(&scene, &SMALL).unwrap(), grey)
    };
    let body = vec![Surface::body(&table.0, &table.1)];
    let [through, hidden] = [0.0, 5e-3].map(|bias| grey_pixels(bias, body.clone()));
    assert!(through > 10_000, "{through}");
    // The hem is nearly grey too, more so in the shade.
    let hem = grey_pixels(0.0, Vec::new());
    assert!(hidden < 2 * hem, "{hidden} grey pixels, {hem} of them the hem");
}

#[test]
fn the_floor_shows_shadow_and_nothing_else() {
    let shape = sphere(0.2, [0.0, 0.2, 0.0]);
    let scene = |floor| Scene {
        bodies: vec![Surface::body(&shape.0, &shape.1)],
        floor,
        ..Scene::default()
    };
    let bare = render(&scene(None), &SMALL).unwrap();
    let shaded = render(&scene(Some(0.0)), &SMALL).unwrap();
    let mut darker = 0;
    for (a, b) in bare.pixels().chunks(3).zip(shaded.pixels().chunks(3)) {
        if a == [255; 3] {
            assert!(b[0] == b[1] && b[1] == b[2], "the floor has a colour: {b:?}");
            darker += usize::from(b[0] < 235);
        }
    }
    assert!(darker > 1000, "the shadow has {darker} pixels");
    // A shadow takes at most three quarters of the light, as numbers of sRGB.
    let darkest = shaded.pixels().iter().zip(bare.pixels()).filter(|(_, b)| **b == 255);
    let darkest = darkest.map(|(a, _)| *a).min().unwrap();
    assert!((137..200).contains(&darkest), "{darkest}");
    assert_eq!(shaded.pixel(3, 3), Some([255; 3]), "the page is white");
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let (shape, coordinates) = square(0.5, 0.3, 30);
    let ball = sphere(0.25, [0.0; 3]);
    let scene = Scene {
        cloths: vec![cloth(&shape).with_lines(&coordinates, 0.1)],
        bodies: vec![Surface::body(&ball.0, &ball.1)],
        floor: Some(-0.25),
        ..Scene::default()
    };
    let with_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| render(&scene, &SMALL).unwrap().png().unwrap())
    };
    let reference = with_threads(1);
    assert!(with_threads(1) == reference, "a second run differs");
    assert!(with_threads(3) == reference, "three threads differ");
    let shapes = LitShapes::new(&scene).unwrap();
    let lit = shapes.draw(&scene, &SMALL.camera(&scene).unwrap()).unwrap().png().unwrap();
    assert!(lit == reference, "light computed beforehand differs");
}

#[test]
fn a_saved_picture_reads_back_pixel_by_pixel() {
    let (shape, coordinates) = square(0.5, 0.0, 6);
    let scene =
        Scene { cloths: vec![cloth(&shape).with_lines(&coordinates, 0.1)], ..Scene::default() };
    let picture = render(&scene, &SMALL).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("square.png");
    picture.save(&path).unwrap();
    let file = std::io::BufReader::new(std::fs::File::open(&path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut bytes).unwrap();
    assert_eq!((frame.width, frame.height), (400, 300));
    assert!(bytes == picture.pixels(), "pixels changed in the file");
}

#[test]
fn triangles_have_the_colours_of_their_sides_with_smooth_normals_across_a_seam() {
    // Two squares side by side, sewn at x = 0: the same places, but not the same vertices.
    let corners = |left: f64| [[left, 0.0], [left + 0.5, 0.0], [left, 0.5], [left + 0.5, 0.5]];
    let positions: Vec<f64> =
        [-0.5, 0.0].map(corners).as_flattened().iter().flat_map(|[x, z]| [*x, 0.0, *z]).collect();
    let triangles = [[0, 2, 3], [0, 3, 1], [4, 6, 7], [4, 7, 5]];
    let (red, green, blue, yellow) = ([180, 40, 40], [40, 160, 60], [40, 60, 180], [200, 180, 40]);
    let sides = [[red, green], [red, green], [blue, yellow], [blue, yellow]];
    let surface = Surface::cloth(&positions, &triangles).with_sides(&sides);
    let scene = Scene { cloths: vec![surface], ..Scene::default() };
    for (elevation_deg, [left, right]) in [(90.0, [red, blue]), (-90.0, [green, yellow])] {
        let view = View { azimuth_deg: 0.0, elevation_deg, ..SMALL };
        let camera = view.camera(&scene).unwrap();
        let picture = render(&scene, &view).unwrap();
        for (x, colour) in [(-0.25, left), (0.25, right)] {
            let ScreenPoint { x, y, .. } = camera.project([x, 0.0, 0.25]);
            let seen = picture.pixel(x as u32, y as u32).unwrap().map(f64::from);
            // Light scales the channels alike in linear light: their order stays, and so does the
            // hue.
            let strongest = |of: [f64; 3]| (0..3).max_by(|a, b| of[*a].total_cmp(&of[*b]));
            assert_eq!(strongest(seen), strongest(colour.map(f64::from)), "{seen:?}, {colour:?}");
        }
    }
    let plain = Scene { cloths: vec![Surface { sides: None, ..surface }], ..Scene::default() };
    let sewn = LitShapes::new(&plain).unwrap();
    let camera = SMALL.camera(&plain).unwrap();
    assert_eq!(sewn.draw(&scene, &camera).unwrap(), render(&scene, &SMALL).unwrap());
}
