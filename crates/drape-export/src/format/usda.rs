//! USDA, Universal Scene Description as text: panels and bodies with their positions over time.

use std::fmt::Display;
use std::io::{self, Write};

use crate::clip::Clip;
use crate::error::Error;
use crate::mesh::{self, Mesh, MeshKind, Sample, Track};
use crate::name;

/// Bytes of positions and normals that are in memory at once. Meshes that do not fit are read in a
/// further pass over the frames.
const MEMORY: usize = 1 << 28;

/// Writes `clip` to `to` as USDA: in m, y up, a mesh and a material for each panel and body,
/// positions and normals as time samples at the times of the frames.
///
/// Time codes are frames at the rate of the clip, from its first frame. Texture coordinates (`st`)
/// are pattern coordinates in m. Names of prims are identifiers. The name in the run is the display
/// name and the custom data `name`, the fabric is the custom data `fabric`.
///
/// # Errors
/// Frames cannot be read, or `to` fails.
pub fn write_usda(clip: &Clip, mut to: impl Write) -> Result<(), Error> {
    let meshes = mesh::meshes(clip.recording(), &clip.read(0)?);
    let names = name::identifiers(meshes.iter().map(|mesh| &*mesh.name));
    head(clip, &mut to)?;
    writeln!(
        to,
        "def Xform \"run\" (\n    kind = \"component\"\n)\n{{\n    def Scope \"materials\"\n    {{"
    )?;
    for (mesh, name) in meshes.iter().zip(&names) {
        material(mesh, name, &mut to)?;
    }
    writeln!(to, "    }}")?;

    let codes: Vec<f64> =
        clip.seconds().iter().map(|seconds| code(seconds * clip.rate())).collect();
    let mut remaining = &meshes[..];
    let mut names = names.iter();
    while !remaining.is_empty() {
        let (group, rest) = remaining.split_at(fitting_count(remaining, clip.frame_count()));
        for ((mesh, track), name) in group.iter().zip(Track::read(clip, group)?).zip(&mut names) {
            let samples = TimeSamples { codes: &codes, samples: &track.samples };
            prim(mesh, name, &samples, &mut to)?;
        }
        remaining = rest;
    }
    writeln!(to, "}}")?;
    Ok(())
}

/// Returns how many of `meshes`, from the first on, fit into memory with `frames` frames; at least
/// one.
fn fitting_count(meshes: &[Mesh], frames: usize) -> usize {
    let mut bytes = 0;
    let fitting = meshes.iter().take_while(|mesh| {
        bytes += mesh.vertices.len() * frames * size_of::<[f32; 6]>();
        bytes <= MEMORY
    });
    fitting.count().max(1)
}

/// Returns the time code of the time `frames`, in frames. Numbers within rounding of a whole number
/// become whole.
fn code(frames: f64) -> f64 {
    let rounded = (1e6 * frames).round() / 1e6;
    if (rounded - rounded.round()).abs() <= 1e-5 { rounded.round() } else { rounded }
}

/// Writes the beginning of the file.
fn head(clip: &Clip, to: &mut impl Write) -> io::Result<()> {
    let (rate, seconds) = (clip.rate(), clip.seconds());
    let end = code(seconds[seconds.len() - 1] * rate);
    let start = clip.times()[0];
    writeln!(
        to,
        "#usda 1.0
(
    customLayerData = {{
        string generator = \"drape {}\"
        double startTime = {start}
        string textureCoordinates = \"pattern coordinates, in metres\"
    }}
    defaultPrim = \"run\"
    endTimeCode = {end}
    framesPerSecond = {rate}
    metersPerUnit = 1
    startTimeCode = 0
    timeCodesPerSecond = {rate}
    upAxis = \"Y\"
)
",
        env!("CARGO_PKG_VERSION")
    )
}

/// Writes the material of `mesh`, whose prim has the name `name`.
fn material(mesh: &Mesh, name: &str, to: &mut impl Write) -> io::Result<()> {
    let [red, green, blue] = mesh.colour;
    writeln!(
        to,
        "        def Material \"{name}\"
        {{
            token outputs:surface.connect = </run/materials/{name}/surface.outputs:surface>

            def Shader \"surface\"
            {{
                uniform token info:id = \"UsdPreviewSurface\"
                color3f inputs:diffuseColor = ({red}, {green}, {blue})
                float inputs:roughness = 0.9
                token outputs:surface
            }}
        }}"
    )
}

/// Samples of a mesh with their time codes.
struct TimeSamples<'a> {
    codes: &'a [f64],
    samples: &'a [Sample],
}

/// Writes `mesh` with `samples` as a prim with the name `name`.
fn prim(mesh: &Mesh, name: &str, samples: &TimeSamples, to: &mut impl Write) -> io::Result<()> {
    let kind = match mesh.kind {
        MeshKind::Panel(_) => "panel",
        MeshKind::Body(_) => "body",
    };
    writeln!(
        to,
        "
    def Mesh \"{name}\" (
        prepend apiSchemas = [\"MaterialBindingAPI\"]
        customData = {{
            string fabric = {}
            string kind = \"{kind}\"
            string name = {}
        }}
        displayName = {}
    )
    {{
        uniform bool doubleSided = {}
        uniform token orientation = \"rightHanded\"
        uniform token subdivisionScheme = \"none\"
        rel material:binding = </run/materials/{name}>",
        quoted(&mesh.part.fabric),
        quoted(&mesh.part.name),
        quoted(&mesh.name),
        u8::from(kind == "panel"),
    )?;
    let [red, green, blue] = mesh.colour;
    writeln!(to, "        color3f[] primvars:displayColor = [({red}, {green}, {blue})]")?;

    // The shape, then positions and normals over time.
    line("int[] faceVertexCounts", mesh.triangles.iter().map(|_| 3), to)?;
    line("int[] faceVertexIndices", mesh.triangles.iter().flatten(), to)?;
    samples
        .attribute("float3[] extent", to, |sample, to| tuples(&extent(&sample.positions), to))?;
    samples.attribute("point3f[] points", to, |sample, to| tuples(&sample.positions, to))?;
    match &mesh.kind {
        MeshKind::Panel(pattern) => {
            samples
                .attribute("normal3f[] normals", to, |sample, to| tuples(&sample.normals, to))?;
            interpolated("normal3f[] normals", "vertex", to)?;
            write!(to, "        texCoord2f[] primvars:st = ")?;
            let coordinates: Vec<[f32; 2]> =
                pattern.iter().map(|[x, y]| [*x as f32, *y as f32]).collect();
            tuples(&coordinates, to)?;
            writeln!(to, " (\n            interpolation = \"vertex\"\n        )")?;
        }
        MeshKind::Body(creased) => {
            let normals = "normal3f[] primvars:normals";
            samples.attribute(normals, to, |sample, to| tuples(&sample.normals, to))?;
            interpolated(normals, "faceVarying", to)?;
            line("int[] primvars:normals:indices", creased.corners.iter().flatten(), to)?;
        }
    }
    writeln!(to, "    }}")
}

impl TimeSamples<'_> {
    /// Writes the attribute `name` with a value for each sample, or one value if there is one
    /// sample. `write` writes the value of a sample.
    fn attribute<W: Write>(
        &self,
        name: &str,
        to: &mut W,
        write: impl Fn(&Sample, &mut W) -> io::Result<()>,
    ) -> io::Result<()> {
        if let [sample] = self.samples {
            write!(to, "        {name} = ")?;
            write(sample, to)?;
            return writeln!(to);
        }
        writeln!(to, "        {name}.timeSamples = {{")?;
        for (code, sample) in self.codes.iter().zip(self.samples) {
            write!(to, "            {code}: ")?;
            write(sample, to)?;
            writeln!(to, ",")?;
        }
        writeln!(to, "        }}")
    }
}

/// Writes the interpolation of `attribute`, which was written, over the mesh.
fn interpolated(attribute: &str, interpolation: &str, to: &mut impl Write) -> io::Result<()> {
    writeln!(
        to,
        "        {attribute} (\n            interpolation = \"{interpolation}\"\n        )"
    )
}

/// Writes `attribute` with the list `values` as a line.
fn line(
    attribute: &str,
    values: impl IntoIterator<Item = impl Display>,
    to: &mut impl Write,
) -> io::Result<()> {
    write!(to, "        {attribute} = [")?;
    for (index, value) in values.into_iter().enumerate() {
        if index > 0 {
            to.write_all(b", ")?;
        }
        write!(to, "{value}")?;
    }
    writeln!(to, "]")
}

/// Writes `rows` as a list of tuples.
fn tuples<const N: usize>(rows: &[[f32; N]], to: &mut impl Write) -> io::Result<()> {
    to.write_all(b"[")?;
    for (index, row) in rows.iter().enumerate() {
        if index > 0 {
            to.write_all(b", ")?;
        }
        for (k, number) in row.iter().enumerate() {
            to.write_all(if k == 0 { b"(" } else { b", " })?;
            write!(to, "{number}")?;
        }
        to.write_all(b")")?;
    }
    to.write_all(b"]")
}

/// Returns the smallest and the largest coordinates of `positions`.
fn extent(positions: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let first = positions.first().copied().unwrap_or_default();
    let (mut low, mut high) = (first, first);
    for position in positions {
        low = [0, 1, 2].map(|k| low[k].min(position[k]));
        high = [0, 1, 2].map(|k| high[k].max(position[k]));
    }
    [low, high]
}

/// Returns `text` as a string of the format.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted += "\\\"",
            '\\' => quoted += "\\\\",
            '\n' => quoted += "\\n",
            '\r' => quoted += "\\r",
            '\t' => quoted += "\\t",
            // The letter would end the string of a reader in C.
            '\0' => quoted.push('\u{fffd}'),
            c if c < ' ' || c == '\u{7f}' => quoted += &format!("\\x{:02x}", u32::from(c)),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

#[cfg(test)]
mod tests {
    use drape_frames::Recording;

    use super::*;
    use crate::example;

    fn written(times: &[f64]) -> String {
        let folder = example::folder(times);
        let recording = Recording::open(folder.path()).unwrap();
        let mut text = Vec::new();
        write_usda(&Clip::new(&recording, 0..=times.len() - 1, None).unwrap(), &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    /// Returns the text after a key that comes after another.
    fn after<'a>(text: &'a str, keys: &[&str]) -> &'a str {
        keys.iter().fold(text, |text, key| {
            text.split_once(key).unwrap_or_else(|| panic!("no {key} in {text}")).1
        })
    }

    #[test]
    fn the_head_says_units_axis_and_rate() {
        let text = written(&[1.0, 1.04, 1.08]);
        assert!(text.starts_with("#usda 1.0\n("));
        for line in
            ["metersPerUnit = 1", "upAxis = \"Y\"", "timeCodesPerSecond = 25", "endTimeCode = 2"]
        {
            assert!(text.contains(&format!("    {line}\n")), "{line}");
        }
    }

    #[test]
    fn a_code_that_is_whole_but_for_rounding_is_whole() {
        let codes = [2.999_995, 3.000_005, 2.9999, 2.5, 0.0].map(code);
        assert_eq!(codes, [3.0, 3.0, 2.9999, 2.5, 0.0]);
    }

    #[test]
    fn samples_are_at_the_times_of_the_frames() {
        let text = written(&[0.0, 0.25, 0.5, 0.55]);
        let samples = after(&text, &["def Mesh \"front\"", "point3f[] points.timeSamples = {"]);
        let samples: Vec<&str> =
            samples.lines().skip(1).take_while(|line| line.trim() != "}").collect();
        let codes: Vec<&str> =
            samples.iter().filter_map(|line| Some(line.trim().split_once(':')?.0)).collect();
        assert_eq!(codes, ["0", "1", "2", "2.2"]);
        let numbers = samples[3].split_once(": ").unwrap().1;
        let numbers = numbers
            .split(|c: char| "[](), ".contains(c))
            .filter_map(|word| word.parse::<f32>().ok());
        let stored = mesh::single(&example::cloth(0.55)[..4]).concat();
        assert_eq!(numbers.collect::<Vec<_>>(), stored);
    }

    #[test]
    fn odd_names_are_identifiers_with_the_true_name_beside() {
        let text = written(&[0.0]);
        let panel = after(&text, &["def Scope", "    def Mesh \"back", "customData"]);
        assert!(panel.contains(r#"string name = "back \"</a>{}'\\ #1/袖;é&amp;""#), "{panel}");
        assert!(
            panel.contains("point3f[] points = [(0, 1, 0), (0, 0.5, 0), (0.1, 1, 0)]\n"),
            "{panel}"
        );
        assert!(panel.contains("primvars:st = [(0, 0), (0, 0.5), (-0.25, 0)] ("), "{panel}");
        let body = after(&text, &["def Mesh \"box\""]);
        assert!(body.contains("interpolation = \"faceVarying\""), "{body}");
        assert_eq!(quoted("a\n\u{1}\u{7f}\0"), "\"a\\n\\x01\\x7f\u{fffd}\"");
    }
}
