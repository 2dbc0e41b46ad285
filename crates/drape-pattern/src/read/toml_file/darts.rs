//! Darts of a panel in the project's format.

use drape_input::{Diagnostic, Given, Length};

use super::keys::{DartKeys, EdgeKeys};
use super::panels::{ROUNDING, Reader, key};
use crate::edge::{Edge, distance};
use crate::length::Millimetres;
use crate::mistake::Mistake;
use crate::panel::Panel;
use crate::panel::dart::{Dart, OpenDart};

/// Open dart of a panel.
struct DartOnEdge<'a> {
    /// Index among the darts of the panel in the file.
    index: usize,
    /// Name of the edge.
    edge: &'a str,
    dart: OpenDart,
}

impl Reader<'_> {
    /// Returns `panel` with the darts of `keys`: closed darts are added, open darts are cut into
    /// its edges.
    pub(crate) fn darted(&mut self, panel: Panel, keys: &[DartKeys]) -> Option<Panel> {
        if keys.is_empty() {
            return Some(panel);
        }
        let before = self.mistakes.len();
        let table = key(panel.name());
        let (mut closed, mut open) = (Vec::new(), Vec::new());
        for (index, keys) in keys.iter().enumerate() {
            let key = format!("{table}.dart[{index}]");
            let name = keys.name.clone().unwrap_or_else(|| format!("dart {}", index + 1));
            match (&keys.edge, keys.from) {
                (Some(edge), None) => {
                    let dart = self.open_dart(&key, (&panel, edge), keys, name);
                    open.extend(dart.map(|dart| DartOnEdge { index, edge, dart }));
                }
                (None, Some(from)) => {
                    let dart = self.closed_dart(&key, from, keys, name);
                    closed.extend(dart.map(|dart| (index, dart)));
                }
                _ => {
                    let help = "a closed dart has from and to, its two tips; an open one has edge and at, where its \
                                mouth is";
                    let message =
                        format!("dart {name} of panel {} is neither closed nor open", panel.name());
                    self.fail(&key, message, help);
                }
            }
        }
        if self.mistakes.len() > before {
            return None;
        }
        let mut panel = panel;

        // All darts of an edge are cut together: their positions are counted from its start.
        open.sort_by(|a, b| a.edge.cmp(b.edge).then(a.dart.mouth[0].total_cmp(&b.dart.mouth[0])));
        for darts in open.chunk_by(|a, b| a.edge == b.edge) {
            let open_darts: Vec<OpenDart> =
                darts.iter().map(|on_edge| on_edge.dart.clone()).collect();
            let divided = panel.clone().with_open_darts(darts[0].edge, &open_darts);
            panel = self.sound(divided, &table, |name| {
                darts.iter().find(|on_edge| on_edge.dart.name == name).map(|on_edge| on_edge.index)
            })?;
        }
        for (index, dart) in closed {
            self.sketch.add_hole(panel.name(), dart.hole());
            let darted = panel.clone().with_darts(vec![dart]);
            panel = self.sound(darted, &table, |_| Some(index))?;
        }
        Some(panel)
    }

    /// Returns `panel` if it could be made. Adds its mistakes otherwise, at the keys of its darts
    /// in `table`. `number` returns the index of a dart by its name.
    fn sound(
        &mut self,
        panel: Result<Panel, Vec<Mistake>>,
        table: &str,
        number: impl Fn(&str) -> Option<usize>,
    ) -> Option<Panel> {
        let mistakes = match panel {
            Ok(panel) => return Some(panel),
            Err(mistakes) => mistakes,
        };
        for mistake in &mistakes {
            // A mistake of the whole outline is at the only dart, if there is one.
            let dart = match mistake {
                Mistake::DartMeets { dart, .. }
                | Mistake::DartOutside { dart, .. }
                | Mistake::Mouth { dart, .. } => dart,
                _ => "",
            };
            let key = match number(dart).or_else(|| number("")) {
                Some(index) => format!("{table}.dart[{index}]"),
                None => format!("{table}.dart"),
            };
            let located = self.document.at(&key, mistake.to_string()).help(mistake.help());
            let subject = mistake.subject().or_else(|| located.subject.clone());
            self.mistakes.push(Diagnostic { subject, ..located });
        }
        None
    }

    /// Returns the closed dart `name` that `keys` state at `key`, with its first tip at `from`.
    fn closed_dart(
        &mut self,
        key: &str,
        from: [Given<Length>; 2],
        keys: &DartKeys,
        name: String,
    ) -> Option<Dart> {
        for (key_of_open, is_given) in [("at", keys.at.is_some()), ("depth", keys.depth.is_some())]
        {
            if is_given {
                let help = "remove it, or give edge in place of from";
                self.fail(&format!("{key}.{key_of_open}"), "belongs to an open dart", help);
                return None;
            }
        }

        match (keys.width, &keys.left, &keys.right) {
            (Some(width), None, None) => self.diamond(key, (from, width), keys, name),
            (None, Some(left), Some(right)) => {
                if keys.widest.is_some() {
                    self.fail(&format!("{key}.widest"), "belongs to width", "remove it");
                    return None;
                }
                let left = self.leg(&format!("{key}.left"), from, left)?;
                let right = self.leg(&format!("{key}.right"), from, right)?;
                self.closed_by_legs(key, [left, right], keys, name)
            }
            _ => {
                let help = "give width for straight legs, or both left and right";
                self.fail(key, format!("dart {name} has no single form"), help);
                None
            }
        }
    }

    /// Returns the closed dart `name` with straight legs from `from` and the width `width`.
    fn diamond(
        &mut self,
        key: &str,
        (from, width): ([Given<Length>; 2], Given<Length>),
        keys: &DartKeys,
        name: String,
    ) -> Option<Dart> {
        let Some(to) = keys.to else {
            self.fail(key, "to is missing", "add to = [x, y], the other tip");
            return None;
        };
        let tips = [self.scaled(from), self.scaled(to)];
        let length = distance(tips[0], tips[1]);
        let width = width * self.metres;
        let widest = keys.widest.map_or(0.5 * length, |widest| widest * self.metres);
        if !(width > 0.0 && length > 0.0) {
            let help = "width is the greatest width of the dart, above 0, and its tips are apart";
            self.fail(&format!("{key}.width"), "gives the dart no area", help);
            return None;
        }
        if !(0.0 < widest && widest < length) {
            let length = Millimetres(length);
            let help = format!("a distance from `from`, between 0 and {length}");
            self.fail(&format!("{key}.widest"), "is not between the tips", help);
            return None;
        }
        Some(Dart::diamond(name, tips, width, widest))
    }

    /// Returns the closed dart `name` with the edges of both legs, which must end in one tip.
    fn closed_by_legs(
        &mut self,
        key: &str,
        legs: [Vec<Edge>; 2],
        keys: &DartKeys,
        name: String,
    ) -> Option<Dart> {
        let [Some(left_end), Some(right_end)] =
            legs.each_ref().map(|leg| leg.last().map(|edge| edge.end))
        else {
            let help = "give each leg one edge or more, from tip to tip";
            self.fail(key, "a leg has no edge", help);
            return None;
        };
        let tip = keys.to.map_or(left_end, |to| self.scaled(to));
        if distance(left_end, tip).max(distance(right_end, tip)) > ROUNDING {
            let help = "let the last edge of both legs end at the other tip";
            self.fail(key, "its legs do not end in one tip", help);
            return None;
        }
        Some(Dart::closed(name, legs))
    }

    /// Returns the edges of a leg, which `keys` state at `key`, from the point `from` on.
    fn leg(&mut self, key: &str, from: [Given<Length>; 2], keys: &[EdgeKeys]) -> Option<Vec<Edge>> {
        for (index, edge) in keys.iter().enumerate() {
            if edge.hem.number() != 0.0 || !edge.notches.is_empty() || edge.name.is_some() {
                let help = "an edge of a leg has to, and one of quadratic, cubic and radius";
                let message = "has a name, a hem or notches";
                self.fail(&format!("{key}[{index}]"), message, help);
                return None;
            }
        }
        self.chain(key, from, keys)
    }

    /// Returns the open dart `name` that `keys` state at `key`, on the edge `edge` of `panel`.
    fn open_dart(
        &mut self,
        key: &str,
        (panel, edge): (&Panel, &str),
        keys: &DartKeys,
        name: String,
    ) -> Option<OpenDart> {
        let metres = self.metres;
        let keys_of_closed = [
            ("widest", keys.widest.is_some()),
            ("left", keys.left.is_some()),
            ("right", keys.right.is_some()),
        ];
        if let Some((given, _)) = keys_of_closed.into_iter().find(|(_, is_given)| *is_given) {
            let help = "remove it: the legs of an open dart are straight";
            self.fail(&format!("{key}.{given}"), "belongs to a closed dart", help);
            return None;
        }

        let (Some(at), Some(width)) = (keys.at, keys.width) else {
            let help = "add at, the distance of the middle of its mouth from the start of the edge, and width";
            self.fail(key, format!("dart {name} has no mouth"), help);
            return None;
        };
        let edge = self.edge(panel, &format!("{key}.edge"), edge)?;
        let (at, width) = (at * metres, width * metres);
        let tip = match (keys.to, keys.depth) {
            (Some(to), None) => self.scaled(to),
            (None, Some(depth)) => inward(edge, at, depth * metres),
            _ => {
                let help = "give its tip, by to = [x, y] or by depth, the distance from the edge";
                self.fail(key, format!("dart {name} has no single tip"), help);
                return None;
            }
        };
        Some(OpenDart { name, mouth: [at - 0.5 * width, at + 0.5 * width], tip })
    }
}

/// Returns the point inside of the panel at the distance `depth` from `edge`, at a right angle to
/// it, in m. `along` is the distance from the start of the edge to the foot, in m.
fn inward(edge: &Edge, along: f64, depth: f64) -> [f64; 2] {
    let length = edge.length();
    let step = 1e-4 * length;
    let [before, point, after] =
        [along - step, along, along + step].map(|along| edge.at((along / length).clamp(0.0, 1.0)));
    let chord = [after[0] - before[0], after[1] - before[1]];
    let size = chord[0].hypot(chord[1]).max(f64::MIN_POSITIVE);
    // The cloth is on the left of an edge.
    [point[0] - depth * chord[1] / size, point[1] + depth * chord[0] / size]
}
