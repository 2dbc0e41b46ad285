//! Pictures of a run: of its frames, as a strip, turning, as files of `drape export`; and what is
//! refused.

use std::io::BufReader;
use std::path::Path;

use super::drape;
use super::export::run;

/// Runs a command that must succeed and returns what it says on stdout.
fn succeeds(folder: &Path, arguments: &[&str]) -> String {
    let output = drape(folder, arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments:?}: {said}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Picture of a PNG file, or the parts of an animated one.
struct Decoded {
    size: [u32; 2],
    /// Delays of the pictures of an animation, in ms.
    delays: Vec<u16>,
    pixels: Vec<u8>,
}

fn decoded(path: &Path) -> Decoded {
    let file = BufReader::new(std::fs::File::open(path).expect("a file"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG file");
    let info = reader.info();
    let (size, count) = ([info.width, info.height], info.animation_control().map(|c| c.num_frames));
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut pixels).expect("a picture");
    let mut delays = Vec::new();
    let mut part = pixels.clone();
    for number in 0..count.unwrap_or(0) {
        if number > 0 {
            reader.next_frame(&mut part).expect("a picture");
        }
        let control = reader.info().frame_control().expect("a delay");
        assert_eq!(control.delay_den, 1000);
        delays.push(control.delay_num);
    }
    Decoded { size, delays, pixels }
}

#[test]
fn pictures_have_the_size_the_frame_and_the_colours_that_are_asked_for() {
    let folder = run();
    let folder = folder.path();
    let small = ["--size", "301x200"];
    let picture = |name: &str, arguments: &[&str]| {
        let all = [&["picture", "run", "-o", name], &small[..], arguments].concat();
        succeeds(folder, &all);
        decoded(&folder.join(name))
    };
    let last = picture("last.png", &[]);
    assert_eq!(last.size, [301, 200]);
    assert_eq!(picture("named.png", &["--frame", "last"]).pixels, last.pixels);
    let first = picture("first.png", &["--frame", "0"]);
    assert!(first.pixels != last.pixels, "the sheet falls");
    // The nearest frame is taken.
    assert!(picture("time.png", &["--time", "0.004"]).pixels == first.pixels);
    let red = picture("red.png", &["--fabric-colour", "#e02020,#2020e0", "--without", "bodies"]);
    let is_red = |pixel: &[u8; 3]| pixel[0] / 2 > pixel[1].max(pixel[2]);
    let reds = |pixels: &[u8]| pixels.as_chunks().0.iter().filter(|p| is_red(p)).count();
    assert!(reds(&red.pixels) > 1000 && reds(&last.pixels) == 0, "{}", reds(&red.pixels));
    let views = picture("views.png", &["--view", "front,back,-30:20"]);
    assert_eq!(views.size, [301, 200]);
    let map = picture("map.png", &["--map", "strain-warp", "--range", "-1,1"]);
    assert_eq!(map.size, [301, 200], "with its legend");
    let strip = picture("strip.png", &["--strip", "2"]);
    assert_eq!(strip.size, [300, 200], "two frames of 150 pixels");
    // Without a name it is in the folder of the run; it is replaced.
    for _ in 0..2 {
        let said = succeeds(folder, &["picture", "run", "--map", "shear", "--size", "200x200"]);
        assert!(said.contains("run/picture-00003-shear.png"), "{said}");
    }
    assert!(folder.join("run/picture-00003-shear.png").exists());
}

#[test]
fn animations_loop_with_the_times_of_the_frames() {
    let folder = run();
    let folder = folder.path();
    succeeds(folder, &["picture", "run", "--turntable", "4", "-o", "turn.png", "--size", "90x130"]);
    let turn = decoded(&folder.join("turn.png"));
    assert_eq!((turn.size, turn.delays), ([90, 130], vec![1500; 4]));
    // Frames at 0, 20, 40 and 50 ms; the rate is 50 per second.
    succeeds(folder, &["export", "run", "-o", "film.apng", "--size", "90x130"]);
    assert_eq!(decoded(&folder.join("film.apng")).delays, [20, 20, 10, 20]);
    let size = ["--size", "90x130"];
    let even = ["export", "run", "-o", "even.png", "--format", "apng", "--fps", "100"];
    succeeds(folder, &[&even[..], &size].concat());
    assert_eq!(decoded(&folder.join("even.png")).delays, [10; 6]);
    let sequence = ["export", "run", "-o", "s/a.png", "--frames", "1..2", "--view", "front"];
    succeeds(folder, &[&sequence[..], &size].concat());
    for number in 1..=2 {
        assert_eq!(decoded(&folder.join(format!("s/a-0000{number}.png"))).size, [90, 130]);
    }
    succeeds(folder, &[&["export", "run", "-o", "s/one.png", "--frame", "1"], &size[..]].concat());
    assert_eq!(
        decoded(&folder.join("s/one.png")).size,
        [90, 130],
        "one frame has the name that was given"
    );
}

#[test]
fn what_cannot_be_drawn_is_refused_with_a_remedy_that_works() {
    let folder = run();
    let folder = folder.path();
    let refused = |arguments: &[&str], code: i32, told: &str| {
        let output = drape(folder, arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(said.contains(told), "{arguments:?}: {said}");
    };
    let picture = |arguments: &[&'static str]| [&["picture", "run"], arguments].concat();
    refused(&picture(&["--frame", "9"]), 3, "its frames are 0 to 3");
    refused(&picture(&["--frame", "first"]), 2, "give its number, from 0, or last");
    refused(&picture(&["--time", "7"]), 2, "the times from 0 to 0.05 s");
    refused(&picture(&["--time", "nan"]), 2, "the times from 0 to 0.05 s");
    refused(&picture(&["--view", "top"]), 2, "front, right, back, left, above");
    refused(&picture(&["--size", "10x10"]), 2, "such as 1600x1200");
    refused(
        &picture(&["--size", "200x200", "--view", "front,left,back,right"]),
        2,
        "a larger width",
    );
    refused(&picture(&["--fabric-colour", "red"]), 2, "such as #c8d6e5");
    refused(&picture(&["--map", "heat"]), 2, "strain-warp, strain-weft");
    refused(&picture(&["--map", "shear", "--range", "2,1"]), 2, "such as -2,2");
    refused(&picture(&["--map", "seam-gap"]), 2, "it has strain-warp, strain-weft, shear");
    refused(&picture(&["--turntable", "1"]), 2, "2..=360");
    refused(&["picture", "scene.toml"], 3, "this is a scene, not a run");
    std::fs::remove_file(folder.join("run/frame-00002.npy")).expect("it is there");
    refused(&picture(&[]), 3, "frame-00002.npy");
    succeeds(folder, &["run", "scene.toml", "--no-picture", "--force"]);
    let export = |arguments: &[&'static str]| [&["export", "run", "-o"], arguments].concat();
    refused(&export(&["a.obj", "--map", "shear"]), 2, "add --format png, apng or svg");
    refused(&export(&["a.obj", "--size", "90x130"]), 2, "add --format png or apng");
    succeeds(folder, &export(&["a.svg", "--map", "shear"]));
    let large = ["a.png", "--size", "8000x8000", "--fps", "1000"];
    refused(&export(&large), 2, "a smaller --size, fewer --frames or a lower --fps");
    refused(&export(&["run/summary.json", "--format", "apng"]), 2, "replace it with --force");
}
