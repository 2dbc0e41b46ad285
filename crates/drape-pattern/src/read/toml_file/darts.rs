//! Darts of a panel in the project's own format.

use drape_input::{Diagnostic, Given, Length};

use super::keys::{DartKeys, EdgeKeys};
use super::panels::{Reader, key};
use crate::edge::{Edge, distance};
use crate::length::Millimetres;
use crate::mistake::Mistake;
use crate::panel::Panel;
use crate::panel::dart::{Dart, OpenDart};

/// Open dart with the name of its edge.
struct OnEdge<'a> {
    edge: &'a str,
    dart: OpenDart,
}

impl Reader<'_> {
    /// Returns a panel with its darts: closed ones beside those that it has, and open ones cut into its
    /// edges.
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
                    let dart = self.open(&key, (&panel, edge), keys, name);
                    open.extend(dart.map(|dart| (index, OnEdge { edge, dart })));
                }
                (None, Some(from)) => {
                    closed.extend(self.closed(&key, from, keys, name).map(|dart| (index, dart)));
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
        // The darts of one edge together: their places are counted from its start.
        open.sort_by(|a, b| {
            let order = |own: &OnEdge<'_>| own.dart.mouth[0];
            a.1.edge.cmp(b.1.edge).then(order(&a.1).total_cmp(&order(&b.1)))
        });
        for darts in open.chunk_by(|a, b| a.1.edge == b.1.edge) {
            let own: Vec<OpenDart> = darts.iter().map(|(_, own)| own.dart.clone()).collect();
            let divided = panel.clone().with_open_darts(darts[0].1.edge, &own);
            panel = self.sound(divided, &table, |name| {
                darts.iter().find(|(_, own)| own.dart.name == name).map(|(index, _)| *index)
            })?;
        }
        for (index, dart) in closed {
            self.sketch.add_hole(panel.name(), dart.hole());
            let with = panel.clone().with_darts(vec![dart]);
            panel = self.sound(with, &table, |_| Some(index))?;
        }
        Some(panel)
    }

    /// Returns a panel that could be made; adds the mistakes of another one at its darts, whose numbers
    /// a function knows by their names.
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

    /// Returns a closed dart.
    fn closed(
        &mut self,
        key: &str,
        from: [Given<Length>; 2],
        keys: &DartKeys,
        name: String,
    ) -> Option<Dart> {
        let metres = self.metres;
        let scaled = |p: [Given<Length>; 2]| p.map(|x| x * metres);
        for (own, is_given) in [("at", keys.at.is_some()), ("depth", keys.depth.is_some())] {
            if is_given {
                let help = "remove it, or give edge in place of from";
                self.fail(&format!("{key}.{own}"), "belongs to an open dart", help);
                return None;
            }
        }
        match (keys.width, &keys.left, &keys.right) {
            (Some(width), None, None) => {
                let Some(to) = keys.to else {
                    self.fail(key, "to is missing", "add to = [x, y], the other tip");
                    return None;
                };
                let tips = [scaled(from), scaled(to)];
                let length = distance(tips[0], tips[1]);
                let width = width * metres;
                let widest = keys.widest.map_or(0.5 * length, |widest| widest * metres);
                if !(width > 0.0 && length > 0.0) {
                    let help =
                        "width is the greatest width of the dart, above 0, and its tips are apart";
                    self.fail(&format!("{key}.width"), "gives the dart no area", help);
                    return None;
                }
                if !(0.0 < widest && widest < length) {
                    let length = Millimetres(length);
                    let message = "is not between the tips".to_owned();
                    let help = format!("a distance from `from`, between 0 and {length}");
                    self.fail(&format!("{key}.widest"), message, help);
                    return None;
                }
                Some(Dart::diamond(name, tips, width, widest))
            }
            (None, Some(left), Some(right)) => {
                if keys.widest.is_some() {
                    self.fail(&format!("{key}.widest"), "belongs to width", "remove it");
                    return None;
                }
                let left = self.leg(&format!("{key}.left"), from, left)?;
                let right = self.leg(&format!("{key}.right"), from, right)?;
                let (Some(one), Some(other)) = (left.last(), right.last()) else {
                    self.fail(
                        key,
                        "a leg has no edge",
                        "give each leg one edge or more, from tip to tip",
                    );
                    return None;
                };
                let tip = keys.to.map_or(one.end, scaled);
                if distance(one.end, tip).max(distance(other.end, tip)) > ROUNDING {
                    let help = "let the last edge of both legs end at the other tip";
                    self.fail(key, "its legs do not end in one tip", help);
                    return None;
                }
                Some(Dart::closed(name, [left, right]))
            }
            _ => {
                let help = "give width for straight legs, or both left and right";
                self.fail(key, format!("dart {name} has no single form"), help);
                None
            }
        }
    }

    /// Returns the edges of a leg.
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

    /// Returns an open dart.
    fn open(
        &mut self,
        key: &str,
        (panel, edge): (&Panel, &str),
        keys: &DartKeys,
        name: String,
    ) -> Option<OpenDart> {
        let metres = self.metres;
        let others = [
            ("widest", keys.widest.is_some()),
            ("left", keys.left.is_some()),
            ("right", keys.right.is_some()),
        ];
        if let Some((own, _)) = others.into_iter().find(|(_, is_given)| *is_given) {
            let help = "remove it: the legs of an open dart are straight";
            self.fail(&format!("{key}.{own}"), "belongs to a closed dart", help);
            return None;
        }
        let (Some(at), Some(width)) = (keys.at, keys.width) else {
            let help = "add at, the distance of the middle of its mouth from the start of the edge, and width";
            self.fail(key, format!("dart {name} has no mouth"), help);
            return None;
        };
        let own = self.edge(panel, &format!("{key}.edge"), edge)?;
        let (at, width) = (at * metres, width * metres);
        let tip = match (keys.to, keys.depth) {
            (Some(to), None) => to.map(|x| x * metres),
            (None, Some(depth)) => inward(own, at, depth * metres),
            _ => {
                let help = "give its tip, by to = [x, y] or by depth, the distance from the edge";
                self.fail(key, format!("dart {name} has no single tip"), help);
                return None;
            }
        };
        Some(OpenDart { name, mouth: [at - 0.5 * width, at + 0.5 * width], tip })
    }
}

/// Distance of two tips that are one, in m.
const ROUNDING: f64 = 1e-6;

/// Returns the point at a distance from an edge, inside of the panel, at a right angle to the edge.
fn inward(edge: &Edge, along: f64, depth: f64) -> [f64; 2] {
    let length = edge.length();
    let at = |along: f64| edge.at((along / length).clamp(0.0, 1.0));
    let step = 1e-4 * length;
    let (before, point, after) = (at(along - step), at(along), at(along + step));
    let chord = [after[0] - before[0], after[1] - before[1]];
    let size = chord[0].hypot(chord[1]).max(f64::MIN_POSITIVE);
    // The cloth is on the left of an edge.
    [point[0] - depth * chord[1] / size, point[1] + depth * chord[0] / size]
}
