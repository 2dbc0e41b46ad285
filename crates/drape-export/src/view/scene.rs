//! Scene: one run as the elements of a page.

use std::path::Path;

use drape_frames::{EnergyTable, Error, Frame, Recording, SurfacePart};
use serde_json::{Value, json};

use super::bits::{Bounds, Differences, deflated, octet};
use super::element::json_element;
use super::measures::tables;
use super::named::Named;
use super::samples::{Samples, ShownField, ShownSamples};
use crate::palette::{FabricPalette, hex};
use crate::scale;

/// Least number of bytes of a vertex of the cloth in a frame of the page. Waving cloth needs 7
/// bytes. Frames that cannot fit with this number are not read.
const BYTES_OF_SAMPLE: usize = 4;

/// Run as the elements of a page.
pub(super) struct Scene {
    /// Numbers of the frames that are shown.
    pub(super) frames: Vec<usize>,
    meta: Value,
    data: String,
}

impl Scene {
    /// Returns the scene of `run` in the colours of `palette`. Frames are left out until the
    /// elements of the scene have at most `size` bytes, or two frames remain.
    pub(super) fn of_size(
        run: &Named<'_>,
        palette: &FabricPalette,
        size: usize,
    ) -> Result<Scene, Error> {
        let samples = Samples::new(run.recording, size / BYTES_OF_SAMPLE)?;
        let last = samples.frames.len() - 1;
        let mut stride = 1;
        loop {
            let scene = Scene::new(run, palette, &samples, stride)?;
            let length = scene.elements(0).len();
            if length <= size || stride >= last {
                return Ok(scene);
            }
            stride = (stride * length.div_ceil(size.max(1))).clamp(stride + 1, last);
        }
    }

    /// Returns the scene of the last of `samples`, and of every `stride`-th sample before it.
    fn new(
        run: &Named<'_>,
        palette: &FabricPalette,
        samples: &Samples,
        stride: usize,
    ) -> Result<Scene, Error> {
        let recording = run.recording;
        let last = samples.frames.len() - 1;
        let mut chosen: Vec<usize> = (0..last).step_by(stride.max(1)).collect();
        chosen.push(last);
        let ShownSamples { frames, fields } = samples.shown(&chosen);
        let content = Content::new(recording, &frames, &fields);
        let data = deflated(&content.bytes).map_err(|error| Error::Unreadable {
            path: recording.folder().unwrap_or(Path::new("page")).to_owned(),
            reason: error.to_string(),
        })?;
        let mut meta = meta(run, &frames, &fields, &content)?;
        meta["panels"] =
            recording.manifest().panels.iter().map(|part| panel(part, palette)).collect();
        Ok(Scene { frames: frames.iter().map(|frame| frame.number).collect(), meta, data })
    }

    /// Returns the elements of the page that hold the scene, with its number among the runs.
    pub(super) fn elements(&self, number: usize) -> String {
        let meta = json_element(&format!("run-{number}"), &self.meta);
        let data = &self.data;
        format!("{meta}<script type=\"text/plain\" id=\"data-{number}\">{data}</script>\n")
    }
}

/// Numbers of a scene as bytes.
struct Content {
    bytes: Vec<u8>,
    bounds: Bounds,
    body_bounds: Vec<Bounds>,
    /// State of the bodies in each frame.
    body_states: Vec<usize>,
}

impl Content {
    fn new(recording: &Recording, frames: &[&Frame], fields: &[ShownField<'_>]) -> Content {
        let (topology, manifest) = (recording.topology(), recording.manifest());
        let mut bytes = Vec::new();
        // The page reads the numbers in this order.
        bytes.extend(topology.cloth.iter().flatten().flat_map(|corner| corner.to_le_bytes()));
        let material = topology.material.iter().flatten();
        bytes.extend(material.flat_map(|length| (*length as f32).to_le_bytes()));
        bytes.extend(topology.bodies.iter().flatten().flat_map(|corner| corner.to_le_bytes()));
        bytes.extend(manifest.seam_pairs.iter().flatten().flat_map(|vertex| vertex.to_le_bytes()));

        let bounds = frames.iter().fold(Bounds::EMPTY, |all, frame| all.with(&frame.cloth));
        let mut clothes = Differences::<u16>::new();
        for frame in frames {
            let words = frame.cloth.iter().flat_map(|point| bounds.words(*point)).collect();
            clothes.add(words, &mut bytes);
        }
        let body_bounds = body_bounds(&manifest.bodies, frames);
        let body_states = body_states(frames);
        let mut bodies = Differences::<u16>::new();
        for (k, frame) in frames.iter().enumerate() {
            if k == 0 || body_states[k] != body_states[k - 1] {
                bodies.add(body_words(&manifest.bodies, &body_bounds, frame), &mut bytes);
            }
        }
        for shown in fields {
            let mut octets = Differences::<u8>::new();
            for values in &shown.values {
                let all =
                    values.iter().map(|value| octet(f64::from(*value), shown.range)).collect();
                octets.add(all, &mut bytes);
            }
        }
        Content { bytes, bounds, body_bounds, body_states }
    }
}

/// Returns the box of each of `bodies` over all `frames`.
fn body_bounds(bodies: &[SurfacePart], frames: &[&Frame]) -> Vec<Bounds> {
    let mut first = 0;
    let mut bounds = Vec::new();
    for body in bodies {
        let vertices = first..first + body.vertices;
        first = vertices.end;
        let places = frames.iter().map(|frame| &frame.bodies[vertices.clone()]);
        bounds.push(places.fold(Bounds::EMPTY, |all, places| all.with(places)));
    }
    bounds
}

/// Returns the number of the state of the bodies in each of `frames`. The number rises where the
/// bodies have moved.
fn body_states(frames: &[&Frame]) -> Vec<usize> {
    let mut states: Vec<usize> = Vec::new();
    for (k, frame) in frames.iter().enumerate() {
        let state = match k.checked_sub(1) {
            None => 0,
            Some(before) => {
                let moved = frames[before].bodies_frame != frame.bodies_frame;
                states[before] + usize::from(moved)
            }
        };
        states.push(state);
    }
    states
}

/// Returns the positions of the vertices of `bodies` in `frame`, in units of their `bounds`.
fn body_words(bodies: &[SurfacePart], bounds: &[Bounds], frame: &Frame) -> Vec<u16> {
    let mut vertices = frame.bodies.iter();
    let mut words = Vec::new();
    for (body, bounds) in bodies.iter().zip(bounds) {
        let points = vertices.by_ref().take(body.vertices);
        words.extend(points.flat_map(|point| bounds.words(*point)));
    }
    words
}

/// Returns the description of the panel `part` for the page, with the colours of its fabric.
fn panel(part: &SurfacePart, palette: &FabricPalette) -> Value {
    let [front, back] = palette.sides(&part.fabric);
    json!({
        "name": part.name, "triangles": part.triangles, "fabric": part.fabric,
        "colour": hex(front), "back": hex(back),
    })
}

/// Returns the lower and the upper corner of `bounds`.
fn corners(bounds: &Bounds) -> Value {
    json!([bounds.low, bounds.high])
}

/// Returns the description of the body `part` for the page.
fn body_entry(part: &SurfacePart, bounds: &Bounds) -> Value {
    json!({
        "name": part.name, "vertices": part.vertices, "triangles": part.triangles,
        "box": corners(bounds),
    })
}

/// Returns the description of `frame` for the page, with the state of its bodies, or -1 for a run
/// without bodies.
fn frame_entry(frame: &Frame, body_state: Option<usize>) -> Value {
    json!({
        "number": frame.number, "time": frame.time,
        "bodies": body_state.map_or(-1, |state| state as i64),
    })
}

/// Returns the description of the field `shown` for the page, in a run of `frame_count` frames.
fn field_entry(shown: &ShownField<'_>, frame_count: usize) -> Value {
    json!({
        "key": shown.field.key(), "label": shown.field.label(), "unit": shown.field.unit(),
        "stops": scale::stops(shown.field.is_signed()), "low": shown.range[0],
        "high": shown.range[1], "signed": shown.field.is_signed(),
        "first": if shown.values.len() == frame_count { 0 } else { -1 },
    })
}

/// Returns the description of `run` for the page, without its panels.
fn meta(
    run: &Named<'_>,
    frames: &[&Frame],
    fields: &[ShownField<'_>],
    content: &Content,
) -> Result<Value, Error> {
    let (topology, manifest) = (run.recording.topology(), run.recording.manifest());
    let has_bodies = !manifest.bodies.is_empty();

    // Bodies and frames, by the states of the bodies.
    let bodies = manifest.bodies.iter().zip(&content.body_bounds);
    let bodies: Vec<Value> = bodies.map(|(part, bounds)| body_entry(part, bounds)).collect();
    let states = content.body_states.iter().map(|&state| has_bodies.then_some(state));
    let frame_entries: Vec<Value> =
        frames.iter().zip(states).map(|(frame, state)| frame_entry(frame, state)).collect();
    let last_state = content.body_states.last().copied();
    let body_states = if has_bodies { last_state.map_or(0, |state| state + 1) } else { 0 };

    let energy =
        run.recording.energy()?.filter(|table| table.rows.last().is_some_and(Option::is_some));
    let energy = energy.map(|EnergyTable { names, rows }| {
        json!({ "names": names, "rows": frames.iter().map(|frame| &rows[frame.number]).collect::<Vec<_>>() })
    });
    // A pipe in place of the summary would wait for its writer.
    let summary = run.recording.folder().map(|folder| folder.join("summary.json"));
    let summary = summary.filter(|path| path.is_file());
    let summary = summary.and_then(|path| std::fs::read_to_string(path).ok());
    let summary = summary.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or(Value::Null);
    Ok(json!({
        "name": run.name,
        "note": note(run.recording, frames, &content.bounds),
        "vertices": topology.material.len(), "triangles": topology.cloth.len(),
        "bodyVertices": frames[0].bodies.len(), "bodyTriangles": topology.bodies.len(),
        "bodyStates": body_states, "pairs": manifest.seam_pairs.len(),
        "box": corners(&content.bounds),
        "bodies": bodies,
        "frames": frame_entries,
        "fields": fields.iter().map(|shown| field_entry(shown, frames.len())).collect::<Vec<_>>(),
        "measures": tables(&summary),
        "warnings": warnings(&summary),
        "energy": energy,
    }))
}

/// Returns what a reader of the results must know, from the `summary` of the run: a status that is
/// not `ok`, with its reason, and the warnings.
fn warnings(summary: &Value) -> Vec<String> {
    let status = summary["status"].as_str().filter(|status| *status != "ok");
    let end = status.map(|status| match summary["reason"].as_str() {
        Some(reason) => format!("the run ended with the status \"{status}\": {reason}"),
        None => format!("the run ended with the status \"{status}\""),
    });
    let warnings = summary["warnings"].as_array().into_iter().flatten();
    end.into_iter().chain(warnings.filter_map(|text| text.as_str().map(str::to_owned))).collect()
}

/// Returns how many frames are shown, and how exactly.
fn note(recording: &Recording, frames: &[&Frame], bounds: &Bounds) -> String {
    let size = (0..3).map(|axis| bounds.high[axis] - bounds.low[axis]).fold(0.0, f64::max);
    let all = recording.frame_count();
    let shown = match frames.len() {
        count if count == all => format!("{all} frames"),
        count => format!("{count} of {all} frames"),
    };
    let vertices = recording.topology().material.len();
    format!("{vertices} particles, {shown}, positions to {:.0} µm", 1e6 * size / 65535.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn a_page_tells_how_a_run_ended_if_it_did_not_end_well() {
        let told = |summary: Value| warnings(&summary);
        assert!(told(json!({ "status": "ok", "warnings": [] })).is_empty());
        assert!(told(Value::Null).is_empty());
        let end = json!({ "status": "seams open", "reason": "side is open", "warnings": ["thin"] });
        let words = ["the run ended with the status \"seams open\": side is open", "thin"];
        assert_eq!(told(end), words);
    }

    #[test]
    fn bodies_have_a_new_state_where_they_have_moved() {
        let folder = example::folder_of_rising_box(&[0.0, 0.0, 0.25, 0.5, 0.5]);
        let recording = Recording::open(folder.path()).unwrap();
        let frames: Vec<Frame> = (0..5).map(|number| recording.frame(number).unwrap()).collect();
        let frames: Vec<&Frame> = frames.iter().collect();
        assert_eq!(body_states(&frames), [0, 0, 1, 2, 2]);
    }
}
