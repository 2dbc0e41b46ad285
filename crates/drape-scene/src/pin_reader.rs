use drape_input::closest;

use crate::file::{PinFile, SceneFile};
use crate::panel::Panel;
use crate::pin::{Pin, Until};
use crate::reader::Reader;

impl Reader<'_> {
    /// What a pin holds, and how that moves.
    pub(crate) fn pin(
        &mut self,
        index: usize,
        pin: &PinFile,
        (panels, unit): (&[Panel], f64),
        positions: &[f64],
    ) -> Option<Pin> {
        let key = format!("pin[{index}]");
        let names: Vec<&str> = panels.iter().map(|p| p.name.as_str()).collect();
        let Some(panel) = panels.iter().find(|p| p.name == pin.panel) else {
            let help = format!("the panels of this scene are: {}", names.join(", "));
            self.fail(
                &format!("{key}.panel"),
                format!("there is no panel \"{}\"", pin.panel),
                &help,
            );
            return None;
        };
        let mut particles = self.points(&key, pin, panel, unit);
        if let Some(edge) = pin.edge.as_deref() {
            if panel.edges.is_empty() {
                particles.extend(self.edge(&key, edge, (panel, pin.rows.unwrap_or(1))));
            } else {
                particles.extend(self.named_edge(&key, edge, panel));
            }
        }
        if pin.points.is_empty() && pin.edge.is_none() {
            let help = "give points = [[u, v], …] or edge = \"top\"";
            self.fail(&key, "the pin holds nothing".into(), help);
            return None;
        }
        if pin.rows.is_some() && pin.edge.is_none() {
            let help = "rows = 2 belongs to an edge";
            self.fail(&format!("{key}.rows"), "there is no edge".into(), help);
        }
        particles.sort_unstable();
        particles.dedup();
        let place = |&particle: &usize| std::array::from_fn(|axis| positions[3 * particle + axis]);
        let start: Vec<[f64; 3]> = particles.iter().map(place).collect();
        let middle = std::array::from_fn(|axis| {
            start.iter().map(|place| place[axis]).sum::<f64>() / start.len() as f64
        });
        let track = match &pin.motion {
            Some(motion) => Some(self.track(&format!("{key}.motion"), motion, (middle, unit))?),
            None => None,
        };
        let release = pin.release.unwrap_or(f64::INFINITY);
        if pin.release.is_some() {
            self.within(&format!("{key}.release"), release, (0.0, 1e5), "when it lets go, in s");
        }
        let choices = [("end", Until::End), ("sewn", Until::Sewn), ("rest", Until::Rest)];
        let until = self.choice(&format!("{key}.until"), pin.until.as_deref(), &choices);
        let axes = self.axes(&key, pin);
        Some(Pin { particles, start, track, release, until, axes })
    }

    /// Whether a pin holds along x, y and z.
    fn axes(&mut self, key: &str, pin: &PinFile) -> [bool; 3] {
        let Some(names) = &pin.axes else { return [true; 3] };
        if names.is_empty() {
            let help = "axes = [\"y\"] holds up and down; without axes it holds altogether";
            self.fail(&format!("{key}.axes"), "it holds in no direction".into(), help);
        }
        let mut axes = [false; 3];
        for (number, name) in names.iter().enumerate() {
            let key = format!("{key}.axes[{number}]");
            axes[self.choice(&key, Some(name.as_str()), &[("x", 0), ("y", 1), ("z", 2)])] = true;
        }
        axes
    }

    /// A pin that holds until the cloth has come to rest lets go only where something follows.
    pub(crate) fn pins_let_go(&mut self, file: &SceneFile) {
        for (index, pin) in file.pin.iter().enumerate() {
            if pin.until.as_deref() == Some("rest") && file.motion.is_none() {
                let help = "leave until out, or add [motion] with what follows the rest";
                self.fail(&format!("pin[{index}].until"), "the run ends at rest".into(), help);
            }
        }
    }

    /// The particles of an edge of a garment's panel.
    fn named_edge(&mut self, key: &str, edge: &str, panel: &Panel) -> Vec<usize> {
        if let Some((_, nodes)) = panel.edges.iter().find(|(name, _)| name == edge) {
            return nodes.iter().map(|&node| panel.first + node as usize).collect();
        }
        let names: Vec<&str> = panel.edges.iter().map(|(name, _)| name.as_str()).collect();
        let help = match closest(edge, names.iter().copied()) {
            Some(near) => format!("did you mean \"{near}\"? its edges are: {}", names.join(", ")),
            None => format!("its edges are: {}", names.join(", ")),
        };
        let message = format!("panel \"{}\" has no edge \"{edge}\"", panel.name);
        self.fail(&format!("{key}.edge"), message, &help);
        Vec::new()
    }

    /// The particles nearest to the places that a pin names, or all within its radius of them.
    fn points(&mut self, key: &str, pin: &PinFile, panel: &Panel, unit: f64) -> Vec<usize> {
        let coordinates = panel.lattice.panel_coordinates();
        let [across, along] = panel.lattice.spacing;
        let mut particles = Vec::new();
        for (number, point) in pin.points.iter().enumerate() {
            let [u, v] = point.map(|x| x * unit);
            let distance = |c: &[f64; 2]| (c[0] - u).hypot(c[1] - v);
            let by_distance = |a: &usize, b: &usize| {
                distance(&coordinates[*a]).total_cmp(&distance(&coordinates[*b]))
            };
            let nearest = (0..coordinates.len()).min_by(by_distance);
            if let Some(radius) = pin.radius {
                let within = |&place: &usize| distance(&coordinates[place]) <= radius * unit;
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
                    let message = format!("{point:?} is not on panel \"{}\"", panel.name);
                    let help = "places are width × height from the lower left corner of a rectangle, \
                                from the middle of a disc";
                    self.fail(&format!("{key}.points[{number}]"), message, help);
                }
            }
        }
        particles
    }

    /// The particles of the outermost rows along an edge: those less than half a spacing farther inside it than the last
    /// of the rows, also where the rows run at an angle to it.
    fn edge(&mut self, key: &str, edge: &str, (panel, rows): (&Panel, usize)) -> Vec<usize> {
        let edges =
            [("top", (1, 1.0)), ("bottom", (1, -1.0)), ("left", (0, -1.0)), ("right", (0, 1.0))];
        let (axis, end) = self.choice(&format!("{key}.edge"), Some(edge), &edges);
        let depths = panel.lattice.depths(axis, end);
        let numbered = depths.iter().enumerate().filter(|(_, depth)| **depth < rows as f64 - 0.5);
        let particles: Vec<usize> = numbered.map(|(particle, _)| panel.first + particle).collect();
        if particles.is_empty() {
            self.fail(&format!("{key}.rows"), "holds nothing".into(), "rows = 1 or more");
        }
        particles
    }
}
