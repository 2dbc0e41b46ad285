use crate::file::PinFile;
use crate::panel::Panel;
use crate::reader::Reader;

impl Reader<'_> {
    pub(crate) fn pin(
        &mut self,
        index: usize,
        pin: &PinFile,
        (panels, unit): (&[Panel], f64),
        held: &mut [bool],
    ) {
        let key = format!("pin[{index}]");
        let names: Vec<&str> = panels.iter().map(|p| p.name.as_str()).collect();
        let Some(panel) = panels.iter().find(|p| p.name == pin.panel) else {
            let help = format!("the panels of this scene are: {}", names.join(", "));
            self.fail(
                &format!("{key}.panel"),
                format!("there is no panel \"{}\"", pin.panel),
                &help,
            );
            return;
        };
        let coordinates = &panel.lattice.coordinates;
        let [across, along] = panel.lattice.spacing;
        for (number, point) in pin.points.iter().enumerate() {
            let [u, v] = point.map(|x| x * unit);
            let distance = |c: &[f64; 2]| (c[0] - u).hypot(c[1] - v);
            let by_distance = |a: &usize, b: &usize| {
                distance(&coordinates[*a]).total_cmp(&distance(&coordinates[*b]))
            };
            let nearest = (0..coordinates.len()).min_by(by_distance);
            match nearest {
                Some(nearest) if distance(&coordinates[nearest]) <= across.hypot(along) => {
                    held[panel.first + nearest] = true;
                }
                _ => {
                    let message = format!("{point:?} is not on panel \"{}\"", panel.name);
                    let help = "places are weft × warp from the lower left corner of a rectangle, \
                                from the middle of a disc";
                    self.fail(&format!("{key}.points[{number}]"), message, help);
                }
            }
        }
        if let Some(edge) = pin.edge.as_deref() {
            let edges = [
                ("top", (1, 1.0)),
                ("bottom", (1, -1.0)),
                ("left", (0, -1.0)),
                ("right", (0, 1.0)),
            ];
            let (axis, sign) = self.choice(&format!("{key}.edge"), Some(edge), &edges);
            let extreme = coordinates.iter().map(|c| sign * c[axis]).fold(f64::MIN, f64::max);
            for (particle, c) in coordinates.iter().enumerate() {
                if sign * c[axis] > extreme - 0.5 * panel.lattice.spacing[axis] {
                    held[panel.first + particle] = true;
                }
            }
        }
        if pin.points.is_empty() && pin.edge.is_none() {
            let help = "give points = [[u, v], …] or edge = \"top\"";
            self.fail(&key, "the pin holds nothing".into(), help);
        }
    }
}
