//! Pins of a scene.

use drape_input::{closest, excerpt, figures};

use crate::check::checker::{Checker, UnknownName};
use crate::check::motion::rigid_motion;
use crate::check::panel::PlacedPanel;
use crate::scene::panel::Panel;
use crate::scene::pin::{HoldUntil, Pin};
use crate::spec::panel::PanelSpec;
use crate::spec::pin::{Axis, PinSpec};

/// Pin of a scene, with the key of its motion.
pub(crate) struct CheckedPin {
    pub(crate) pin: Pin,
    pub(crate) motion_key: String,
}

/// Checks the pins of placed panels. A pin of a panel that is known and was not placed, for it has
/// mistakes, is not checked further.
pub(crate) fn pins(checker: &mut Checker<'_>, panels: &[PlacedPanel]) -> Vec<CheckedPin> {
    let spec = checker.spec;
    let mut pins = Vec::new();
    for (index, entry) in spec.pin.iter().enumerate() {
        pins.extend(pin(checker, index, entry, panels));
    }
    for (index, entry) in spec.pin.iter().enumerate() {
        // A pin that holds until the cloth has come to rest lets go only where something follows.
        if entry.until == HoldUntil::Rest && spec.motion.is_none() {
            let help = "leave until out, or add [motion] with what follows the rest";
            checker.fail(&format!("pin[{index}].until"), "the run ends at rest", help);
        }
    }
    pins
}

/// Checks a pin.
fn pin(
    checker: &mut Checker<'_>,
    index: usize,
    pin: &PinSpec,
    panels: &[PlacedPanel],
) -> Option<CheckedPin> {
    let key = format!("pin[{index}]");
    let Some(placed) = panels.iter().find(|placed| placed.panel.name == pin.panel) else {
        if !is_left_out(checker, &pin.panel, panels) {
            let names: Vec<&str> = panels.iter().map(|p| p.panel.name.as_str()).collect();
            let message = format!("there is no panel \"{}\"", excerpt(&pin.panel));
            let kind = "panels of this scene";
            let unknown = UnknownName { name: &pin.panel, known: &names, kind };
            checker.unknown(&format!("{key}.panel"), message, unknown);
        }
        return None;
    };
    let (panel, positions) = (&placed.panel, &placed.positions);
    let mut particles = points(checker, &key, pin, panel);
    if let Some(edge) = pin.edge.as_deref() {
        if panel.edges.is_empty() {
            particles.extend(rows_at_edge(checker, &key, pin, panel));
        } else {
            particles.extend(named_edge(checker, &key, edge, panel));
        }
    }
    if pin.points.is_empty() && pin.edge.is_none() {
        let help = "give points = [[u, v], …] or edge = \"top\"";
        checker.fail(&key, "the pin holds nothing", help);
        return None;
    }
    if pin.rows != 1 && pin.edge.is_none() {
        let help = "rows = 2 belongs to an edge";
        checker.fail(&format!("{key}.rows"), "there is no edge", help);
    }
    if pin.radius.is_some() && pin.points.is_empty() {
        let help = "leave it out; rows = 2 holds more of an edge";
        checker.fail(&format!("{key}.radius"), "there are no points", help);
    }
    particles.sort_unstable();
    particles.dedup();
    let place = |&particle: &usize| {
        std::array::from_fn(|axis| positions[3 * (particle - panel.first) + axis])
    };
    let start: Vec<[f64; 3]> = particles.iter().map(place).collect();
    let middle = std::array::from_fn(|axis| {
        start.iter().map(|place| place[axis]).sum::<f64>() / start.len() as f64
    });
    let motion_key = format!("{key}.motion");
    let motion = match &pin.motion {
        Some(motion) => Some(rigid_motion(checker, &motion_key, motion, middle)?),
        None => None,
    };
    let release = pin.release.unwrap_or(f64::INFINITY);
    let axes = axes(checker, &key, pin);
    let pin = Pin { particles, start, motion, release, until: pin.until, axes };
    Some(CheckedPin { pin, motion_key })
}

/// Returns whether a panel of a name may be one that has mistakes.
fn is_left_out(checker: &Checker<'_>, name: &str, placed: &[PlacedPanel]) -> bool {
    let spec = checker.spec;
    let plain = |panel: &PanelSpec| {
        name == panel.name || panel.stack.is_some() && name.starts_with(&panel.name)
    };
    let cut = placed.iter().filter(|placed| !placed.panel.edges.is_empty()).count();
    spec.panel.iter().any(plain) || !spec.garment.is_empty() && cut == 0
}

/// Checks whether a pin holds along x, y and z.
fn axes(checker: &mut Checker<'_>, key: &str, pin: &PinSpec) -> [bool; 3] {
    let Some(axes) = &pin.axes else { return [true; 3] };
    if axes.is_empty() {
        let help = "axes = [\"y\"] holds up and down; without axes it holds altogether";
        checker.fail(&format!("{key}.axes"), "it holds in no direction", help);
    }
    [Axis::X, Axis::Y, Axis::Z].map(|axis| axes.contains(&axis))
}

/// Finds the particles of an edge of a garment's panel.
fn named_edge(checker: &mut Checker<'_>, key: &str, edge: &str, panel: &Panel) -> Vec<usize> {
    if let Some(found) = panel.edges.iter().find(|named| named.name == edge) {
        return found.nodes.iter().map(|&node| panel.first + node as usize).collect();
    }
    let names: Vec<&str> = panel.edges.iter().map(|edge| edge.name.as_str()).collect();
    let help = match closest(edge, names.iter().copied()) {
        Some(near) => format!("did you mean \"{near}\"? its edges are: {}", names.join(", ")),
        None => format!("its edges are: {}", names.join(", ")),
    };
    let message = format!("panel \"{}\" has no edge \"{edge}\"", panel.name);
    checker.fail(&format!("{key}.edge"), message, &help);
    Vec::new()
}

/// Finds the particles nearest to the points that a pin names, or all within its radius of them.
fn points(checker: &mut Checker<'_>, key: &str, pin: &PinSpec, panel: &Panel) -> Vec<usize> {
    let coordinates = panel.lattice.panel_coordinates();
    let [across, along] = panel.lattice.spacing();
    let mut particles = Vec::new();
    for (number, point) in pin.points.iter().enumerate() {
        let [u, v] = *point;
        let distance = |c: &[f64; 2]| (c[0] - u).hypot(c[1] - v);
        let by_distance = |a: &usize, b: &usize| {
            distance(&coordinates[*a]).total_cmp(&distance(&coordinates[*b]))
        };
        let nearest = (0..coordinates.len()).min_by(by_distance);
        if let Some(radius) = pin.radius {
            let within = |&place: &usize| distance(&coordinates[place]) <= radius;
            let before = particles.len();
            particles.extend((0..coordinates.len()).filter(within).map(|p| panel.first + p));
            if particles.len() > before {
                continue;
            }
        }
        match nearest {
            Some(nearest) if distance(&coordinates[nearest]) <= across.hypot(along) => {
                particles.push(panel.first + nearest);
            }
            _ => {
                let key = format!("{key}.points[{number}]");
                let place = checker.written(&key).unwrap_or_else(|| figures(point));
                let message = format!("{place} is not on panel \"{}\"", panel.name);
                let help = "places are width × height from the lower left corner of a rectangle, \
                            from the middle of a disc";
                checker.fail(&key, message, help);
            }
        }
    }
    particles
}

/// Finds the particles of the outermost rows along an edge: those less than half a spacing farther
/// inside it than the last of the rows, also where the rows run at an angle to it.
fn rows_at_edge(checker: &mut Checker<'_>, key: &str, pin: &PinSpec, panel: &Panel) -> Vec<usize> {
    let edges =
        [("top", (1, 1.0)), ("bottom", (1, -1.0)), ("left", (0, -1.0)), ("right", (0, 1.0))];
    let word = pin.edge.as_deref().unwrap_or_default();
    let Some((axis, end)) = checker.choice(&format!("{key}.edge"), word, &edges) else {
        return Vec::new();
    };
    let depths = panel.lattice.depths(axis, end);
    let numbered = depths.iter().enumerate().filter(|(_, depth)| **depth < pin.rows as f64 - 0.5);
    let particles: Vec<usize> = numbered.map(|(particle, _)| panel.first + particle).collect();
    if particles.is_empty() {
        checker.fail(&format!("{key}.rows"), "holds nothing", "rows = 1 or more");
    }
    particles
}
