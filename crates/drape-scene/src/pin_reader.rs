use crate::file::{MotionFile, PinFile};
use crate::panel::Panel;
use crate::pin::{Key, Pin};
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
            particles.extend(self.edge(&key, edge, (panel, pin.rows.unwrap_or(1))));
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
        if let Some(motion) = &pin.motion {
            let held = (particles, positions, unit);
            return self.motion(&format!("{key}.motion"), motion, held);
        }
        Some(Pin::resting(particles))
    }

    /// The particles nearest to the places that a pin names.
    fn points(&mut self, key: &str, pin: &PinFile, panel: &Panel, unit: f64) -> Vec<usize> {
        let coordinates = &panel.lattice.coordinates;
        let [across, along] = panel.lattice.spacing;
        let mut particles = Vec::new();
        for (number, point) in pin.points.iter().enumerate() {
            let [u, v] = point.map(|x| x * unit);
            let distance = |c: &[f64; 2]| (c[0] - u).hypot(c[1] - v);
            let by_distance = |a: &usize, b: &usize| {
                distance(&coordinates[*a]).total_cmp(&distance(&coordinates[*b]))
            };
            let nearest = (0..coordinates.len()).min_by(by_distance);
            match nearest {
                Some(nearest) if distance(&coordinates[nearest]) <= across.hypot(along) => {
                    particles.push(panel.first + nearest);
                }
                _ => {
                    let message = format!("{point:?} is not on panel \"{}\"", panel.name);
                    let help = "places are weft × warp from the lower left corner of a rectangle, \
                                from the middle of a disc";
                    self.fail(&format!("{key}.points[{number}]"), message, help);
                }
            }
        }
        particles
    }

    /// The particles of the outermost rows along an edge.
    fn edge(&mut self, key: &str, edge: &str, (panel, rows): (&Panel, usize)) -> Vec<usize> {
        let edges =
            [("top", (1, 1.0)), ("bottom", (1, -1.0)), ("left", (0, -1.0)), ("right", (0, 1.0))];
        let (axis, sign) = self.choice(&format!("{key}.edge"), Some(edge), &edges);
        let coordinates = &panel.lattice.coordinates;
        let extreme = coordinates.iter().map(|c| sign * c[axis]).fold(f64::MIN, f64::max);
        let depth = (rows as f64 - 0.5) * panel.lattice.spacing[axis];
        let held = |c: &[f64; 2]| sign * c[axis] > extreme - depth;
        let numbered = coordinates.iter().enumerate().filter(|(_, c)| held(c));
        let particles: Vec<usize> = numbered.map(|(particle, _)| panel.first + particle).collect();
        if particles.is_empty() {
            self.fail(&format!("{key}.rows"), "holds nothing".into(), "rows = 1 or more");
        }
        particles
    }

    /// The motion of a pin's particles.
    fn motion(
        &mut self,
        key: &str,
        file: &MotionFile,
        (particles, positions, unit): (Vec<usize>, &[f64], f64),
    ) -> Option<Pin> {
        let count = file.times.len();
        let lists = [("shift", &file.shift), ("turn", &file.turn)];
        for (name, list) in lists {
            if !list.is_empty() && list.len() != count {
                let message = format!("{} places for {count} times", list.len());
                self.fail(&format!("{key}.{name}"), message, "give one for each of the times");
                return None;
            }
        }
        let rising = file.times.windows(2).all(|pair| pair[0] < pair[1]);
        let finite = |list: &[[f64; 3]]| list.iter().flatten().all(|x| x.is_finite());
        if count == 0 || !rising || !finite(&file.shift) || !finite(&file.turn) {
            let help = "give times = [0, 1, …] in s, each later than the one before, and as many \
                        shift = [[x, y, z], …] or turn = [[x, y, z], …]";
            self.fail(key, "the motion is not one".into(), help);
            return None;
        }
        let nought = [0.0; 3];
        let at = |list: &[[f64; 3]], k: usize| list.get(k).copied().unwrap_or(nought);
        let keys = file.times.iter().enumerate().map(|(k, &time)| Key {
            time,
            shift: at(&file.shift, k).map(|x| x * unit),
            turn: at(&file.turn, k),
        });
        let start: Vec<[f64; 3]> = particles
            .iter()
            .map(|&particle| std::array::from_fn(|axis| positions[3 * particle + axis]))
            .collect();
        let middle = std::array::from_fn(|axis| {
            start.iter().map(|place| place[axis]).sum::<f64>() / start.len() as f64
        });
        let center = file.center.map_or(middle, |center| center.map(|x| x * unit));
        Some(Pin { keys: keys.collect(), particles, start, center })
    }
}
