//! Numbers of straight laws against closed forms, and files read back by other readers.

use std::io::{Cursor, Read};
use std::time::{Duration, SystemTime};

use drape_fabric::Fabric;
use drape_input::Document;
use drape_material::{Error, Material};
use serde_json::Value;
use zip::ZipArchive;

/// Straight laws without friction, of which no two numbers are alike.
const STRAIGHT: &str = r#"
    name = "straight, \"no. 2\""
    density = 0.15
    thickness = 0.0004
    surface_friction = 0.25
    shear.stiffness = 40.0
    [warp]
    traction.primed = { stiffness = 3000.0, toe_ratio = 1.0, toe_strain = 0.01, toe_strain_after = 0.01 }
    bending.rigidity = 1.5e-5
    [weft]
    traction.primed = { stiffness = 2000.0, toe_ratio = 1.0, toe_strain = 0.01, toe_strain_after = 0.01 }
    traction.buckling = { strain = 0.004, stiffness = 500.0 }
    bending.rigidity = 0.9e-5
"#;

fn fabric(text: &str) -> Fabric {
    Fabric::from_document(&Document::new("fabric.toml", text)).expect("a fabric")
}

fn straight() -> Material {
    Material::from_fabric(&fabric(STRAIGHT), 20.0).expect("numbers")
}

fn is_near(value: f64, expected: f64) {
    assert!((value / expected - 1.0).abs() < 1e-9, "{value} instead of {expected}");
}

#[test]
fn numbers_of_straight_laws_are_their_coefficients() {
    let material = straight();
    for (index, [stretch, bending]) in [[3000.0, 1.5e-5], [2000.0, 0.9e-5]].into_iter().enumerate()
    {
        is_near(material.stretch[index].stiffness, stretch);
        is_near(material.stretch[index].strain, 20.0 / stretch);
        is_near(material.bending[index], bending);
    }
    // KES G is a chord of the shear force, which follows the sine of the angle; a degree apart in
    // shape makes a few parts in ten thousand.
    assert!((material.shear / 40.0 - 1.0).abs() < 2e-3, "{}", material.shear);
    // Load of a buckled yarn: k0 εb (exp(ε/εb) − 1) − kp ε²/2.
    let compression = |stiffness: f64, strain: f64, beyond: f64| {
        (stiffness * strain * (1.0 - (-0.01 / strain).exp()) + 0.5 * beyond * 1e-4) / 0.01
    };
    is_near(material.compression[0], compression(3000.0, 0.002, 100.0));
    is_near(material.compression[1], compression(2000.0, 0.004, 500.0));
}

#[test]
fn a_stretch_is_read_at_the_load_that_is_asked_for() {
    // F = c ε²: the strain is sqrt(F/c), and the secant sqrt(F c).
    let curved = STRAIGHT.replace(
        "traction.primed = { stiffness = 3000.0, toe_ratio = 1.0, toe_strain = 0.01, toe_strain_after = 0.01 }",
        "traction.polynomial = { quadratic = 8.4e4, quartic = 0.0 }",
    );
    for load in [0.1, 5.0, 20.0, 490.0] {
        let material = Material::from_fabric(&fabric(&curved), load).expect("numbers");
        is_near(material.stretch[0].strain, (load / 8.4e4_f64).sqrt());
        is_near(material.stretch[0].stiffness, (load * 8.4e4_f64).sqrt());
        is_near(material.stretch[1].stiffness, 2000.0);
    }
    for load in [0.0, -1.0, 0.05, 2e4, f64::NAN, f64::INFINITY] {
        let refused = Material::from_fabric(&fabric(&curved), load);
        assert!(matches!(refused, Err(Error::Load { .. })), "{load}: {refused:?}");
    }
}

#[test]
fn a_load_that_is_never_carried_is_refused() {
    let weak = STRAIGHT.replace(
        "traction.primed = { stiffness = 2000.0, toe_ratio = 1.0, toe_strain = 0.01, toe_strain_after = 0.01 }",
        "traction.polynomial = { quadratic = 0.0, quartic = 0.0 }",
    );
    let error = Material::from_fabric(&fabric(&weak), 20.0).expect_err("no stretch");
    assert!(error.to_string().starts_with("the weft does not carry 20 N/m"), "{error}");
}

#[test]
fn what_is_lost_is_said_in_every_format() {
    let rubbing = STRAIGHT.to_owned()
        + "bending.rest_curvature = 3.0\n"
        + "[[weft.bending.friction]]\nplateau = 2e-4\nlength = 20.0\n";
    let material = Material::from_fabric(&fabric(&rubbing), 20.0).expect("numbers");
    let all = material.losses.join("\n");
    for word in [
        "Friction and hysteresis",
        "0 and 0.0004 N wide",
        "Nonlinearity",
        "from rest to 20 N/m",
        "Curl: ",
    ] {
        assert!(all.contains(word), "{word}: {all}");
    }
    let words = |text: &str| text.replace("\n#  ", "").replace("\n# ", " ");
    for text in [material.to_blender(), material.to_ppf()] {
        let text = words(&text);
        assert!(text.contains("Friction and hysteresis"), "{text}");
        assert!(text.contains("the mean of stretch 3000 (warp) and 2000 N/m (weft)"), "{text}");
    }
    for text in [material.to_browzwear(), material.to_u3m(SystemTime::UNIX_EPOCH)] {
        assert!(text.contains("Nonlinearity: "), "{text}");
    }
}

#[test]
fn the_table_for_browzwear_reads_back() {
    let table = straight().to_browzwear();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let rows: Vec<_> = reader.records().map(|row| row.expect("a row")).collect();
    let cell = |property: &str, direction: &str| {
        let mut rows = rows.iter().filter(|row| &row[0] == property && &row[1] == direction);
        let row = rows.next().expect("a row of this property");
        (row[2].to_owned(), row[3].to_owned())
    };
    let pair = |value: &str, unit: &str| (value.to_owned(), unit.to_owned());
    assert_eq!(cell("Mass", ""), pair("150", "g/m²"));
    assert_eq!(cell("Thickness", ""), pair("0.4", "mm"));
    assert_eq!(cell("Friction", ""), pair("0.25", ""));
    // 1.5e-5 N·m is 1.5e-5 · 1e5 dyn · 1e2 cm.
    assert_eq!(cell("Bend", "length"), pair("150", "dyn·cm"));
    assert_eq!(cell("Bend", "width"), pair("90", "dyn·cm"));
    assert_eq!(cell("Stretch", "length"), pair("3000", "N/m"));
    assert_eq!(cell("Stretch", "width"), pair("2000", "N/m"));
    assert_eq!(cell("Shear", ""), pair("", "N/m"));
}

#[test]
fn the_archive_reads_back_and_has_the_fabric_itself() {
    let material = straight();
    let time = SystemTime::UNIX_EPOCH + Duration::from_secs(1_773_063_958);
    let bytes = material.to_u3ma(time);
    assert_eq!(bytes, material.to_u3ma(time), "the same bytes for the same fabric");

    let mut archive = ZipArchive::new(Cursor::new(&bytes)).expect("an archive");
    let names: Vec<String> =
        archive.file_names().map(|name| name.expect("UTF-8").into_owned()).collect();
    assert_eq!(names, ["material.u3m", "fabric.toml"]);
    let mut text = |name: &str| {
        let mut text = String::new();
        let mut file = archive.by_name(name).expect("a file");
        file.read_to_string(&mut text).expect("its checksum is right");
        text
    };
    let laws = text("fabric.toml");
    assert_eq!(fabric(&laws), fabric(STRAIGHT));
    let document: Value = serde_json::from_str(&text("material.u3m")).expect("JSON");
    assert_eq!(document["material"]["name"], "straight, \"no. 2\"");
    assert_eq!(document["material"]["physics"]["weight"], 150.0);
    assert_eq!(document["material"]["physics"]["thickness"], 0.4);
    assert_eq!(document["material"]["modified"], "2026-03-09T13:45:58Z");
    let custom = &document["custom"]["drape"];
    assert_eq!(custom["fabric"], "fabric.toml");
    let values = custom["values"].as_array().expect("values");
    let stretch =
        values.iter().find(|value| value["name"] == "stretch" && value["direction"] == "weft");
    assert_eq!(stretch.expect("its stretch")["value"], 2000.0);
}

#[test]
fn the_archive_keeps_the_rules_of_u3m() {
    let bytes = straight().to_u3ma(SystemTime::UNIX_EPOCH);
    let half = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    let word = |at: usize| usize::from(half(at)) | usize::from(half(at + 2)) << 16;

    // The end is the end, without a comment; its directory follows the files at once.
    let end = bytes.len() - 22;
    assert_eq!(&bytes[end..end + 4], b"PK\x05\x06");
    assert_eq!((half(end + 10), half(end + 20)), (2, 0));
    let (mut at, size) = (word(end + 16), word(end + 12));
    assert_eq!(at + size, end);
    let mut next_file = 0;
    while at < end {
        assert_eq!(&bytes[at..at + 4], b"PK\x01\x02");
        assert_eq!(
            (half(at + 4), half(at + 6), half(at + 8), half(at + 10)),
            (0x3f, 0x14, 0x800, 8)
        );
        // No extra field, comment, disk, attributes.
        assert!(bytes[at + 30..at + 42].iter().all(|&byte| byte == 0));
        let (packed, name) = (word(at + 20), usize::from(half(at + 28)));
        let file = word(at + 42);
        assert_eq!(file, next_file, "no gap between the files");
        assert_eq!(&bytes[file..file + 4], b"PK\x03\x04");
        assert_eq!(bytes[file + 4..file + 30], bytes[at + 6..at + 32]);
        assert_eq!(bytes[file + 30..file + 30 + name], bytes[at + 46..at + 46 + name]);
        next_file = file + 30 + name + packed;
        at += 46 + name;
    }
    assert_eq!(next_file, word(end + 16));
}

#[test]
fn the_profile_for_ppf_contact_solver_reads_back() {
    let table: toml::Table = straight().to_ppf().parse().expect("TOML");
    let profile = table["straight, \"no. 2\""].as_table().expect("one material");
    let number = |key: &str| profile[key].as_float().expect("a number");
    let shear = straight().shear;
    let poisson = shear / 2500.0 / (2.0 * (1.0 + shear / 2500.0));
    let near = |value: f64, expected: f64| {
        assert!((value / expected - 1.0).abs() < 1e-5, "{value} {expected}")
    };
    near(number("shell_poisson_ratio"), poisson);
    near(number("shell_young_modulus"), 2.0 * (1.0 + poisson) * 2500.0 / 0.15);
    near(number("bend"), 1.2e-5 / 1.28e-5 / 0.15);
    near(number("contact_offset"), 0.0002);
    assert_eq!(profile["shell_model"].as_str(), Some("BARAFF_WITKIN"));
}
