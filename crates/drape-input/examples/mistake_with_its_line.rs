//! Reads the mass of a fabric from TOML: a misspelt key and an impossible value are answered with
//! their line and a remedy.

use drape_input::{Diagnostics, Document};

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Fabric {
    name: String,
    /// Mass per unit area, in kg/m².
    density: f64,
}

/// Reads a fabric and checks its mass.
fn read(document: &Document) -> Result<Fabric, Diagnostics> {
    let fabric: Fabric = document.decode()?;
    if fabric.density > 0.0 {
        return Ok(fabric);
    }
    let message = format!("{} kg/m² is not a mass per area", fabric.density);
    Err(document.at("density", message).help("write 0.05 to 0.5 for most fabrics").into())
}

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn main() -> Result<(), Diagnostics> {
    let fabric = read(&Document::new("linen.toml", "name = \"linen\"\ndensity = 0.18\n"))?;
    assert_eq!((fabric.name.as_str(), fabric.density), ("linen", 0.18));

    for (text, line) in [
        ("name = \"linen\"\ndensty = 0.18\n", 2),
        ("# in g/m², by mistake negative\nname = \"linen\"\ndensity = -180\n", 3),
    ] {
        let Err(Diagnostics(mistakes)) = read(&Document::new("linen.toml", text)) else {
            panic!("the text is wrong");
        };
        assert_eq!(mistakes[0].line, Some(line));
        assert!(mistakes[0].help.is_some());
        println!("{}", mistakes[0]);
    }
    Ok(())
}
