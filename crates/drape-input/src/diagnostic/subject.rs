//! Parts of an input that a mistake speaks of, as data for programs that show them.

use crate::node::key_path::{Part, parts};
use crate::node::{Node, Value};

/// Part of an input, by the name that the input gives it.
///
/// ```
/// use drape_input::{Document, Subject};
///
/// let pattern = Document::new("a.toml", "[seam.side]\nsides = [[\"front.left\"], []]");
/// let mistake = pattern.at("seam.side.sides[1]", "is empty");
/// assert_eq!(mistake.subject, Some(Subject::Seam("side".into())));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Subject {
    /// Panel.
    Panel(String),
    /// Edge of a panel.
    Edge {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
    },
    /// Seam.
    Seam(String),
    /// Curve of a sheet, by its file.
    Curve(String),
    /// Body.
    Body(String),
    /// Fabric.
    Fabric(String),
}

impl Subject {
    /// Returns its names, each with its kind, as in `panel`, `front` and `edge`, `left`.
    #[must_use]
    pub fn names(&self) -> Vec<(&'static str, &str)> {
        match self {
            Self::Panel(panel) => vec![("panel", panel)],
            Self::Edge { panel, edge } => vec![("panel", panel), ("edge", edge)],
            Self::Seam(seam) => vec![("seam", seam)],
            Self::Curve(curve) => vec![("curve", curve)],
            Self::Body(body) => vec![("body", body)],
            Self::Fabric(fabric) => vec![("fabric", fabric)],
        }
    }

    /// Returns the part that a key path leads to, or through, if it is a known one.
    pub(crate) fn of_key(root: &Node, key: &str) -> Option<Self> {
        let path: Vec<Part<'_>> = parts(key).collect();
        let mut subject = None;
        let mut node = Some(root);
        for (number, part) in path.iter().enumerate() {
            // A table of tables has the name in the next key, a list of tables in their `name`.
            let element = part.entry(node);
            let named = path.get(number + 1);
            let text = |key: &str| element?.entry(key)?.node.as_text();
            let next = match (part.name, named, &part.indices[..]) {
                ("panel", Some(panel), []) => Some(Self::Panel(panel.name.to_owned())),
                ("panel", _, [_, ..]) => text("name").map(Self::Panel),
                ("seam", Some(seam), []) => Some(Self::Seam(seam.name.to_owned())),
                ("fabric", Some(fabric), []) => Some(Self::Fabric(fabric.name.to_owned())),
                ("curve", _, [_, ..]) => text("file").map(Self::Curve),
                (kind, _, [index, ..]) if number > 0 && path[number - 1].name == "collider" => {
                    let numbered = || format!("{kind} {}", index + 1);
                    Some(Self::Body(text("name").unwrap_or_else(numbered)))
                }
                ("outline", _, [index, ..]) => {
                    let edge = text("name").unwrap_or_else(|| (index + 1).to_string());
                    subject.as_ref().and_then(|panel: &Self| panel.edge(edge))
                }
                ("hems" | "split", Some(edge), []) => {
                    subject.as_ref().and_then(|panel| panel.edge(edge.name.to_owned()))
                }
                _ => None,
            };
            subject = next.or(subject);
            node = element;
        }
        subject
    }

    /// Returns an edge of a panel.
    fn edge(&self, edge: String) -> Option<Self> {
        match self {
            Self::Panel(panel) => Some(Self::Edge { panel: panel.clone(), edge }),
            _ => None,
        }
    }
}

impl Part<'_> {
    /// Returns the value that the part of a key path leads to from a value.
    fn entry<'a>(&self, node: Option<&'a Node>) -> Option<&'a Node> {
        let mut node = &node?.entry(self.name)?.node;
        for index in &self.indices {
            let Value::List(elements) = &node.value else { return None };
            node = elements.get(*index)?;
        }
        Some(node)
    }
}

#[cfg(test)]
mod tests {
    use crate::Document;

    use super::Subject;

    #[test]
    fn a_key_leads_to_the_innermost_part_that_has_a_name() {
        let text = r#"
[[panel]]
name = "towel"
[panel_of.x]
[[collider.mesh]]
file = "body.obj"
[[collider.sphere]]
name = "ball"
[[curve]]
file = "bending.csv"
[[garment]]
panel.front.layer = 0
[fabric.wool]
file = "wool.toml"
"#;
        let document = Document::new("scene.toml", text);
        let of = |key: &str| document.at(key, "is wrong").subject;
        assert_eq!(of("panel[0].center"), Some(Subject::Panel("towel".into())));
        assert_eq!(of("panel[1].center"), None, "there is no such panel");
        assert_eq!(of("collider.mesh[0].scale"), Some(Subject::Body("mesh 1".into())));
        assert_eq!(of("collider.sphere[0]"), Some(Subject::Body("ball".into())));
        assert_eq!(of("curve[0].load.unit"), Some(Subject::Curve("bending.csv".into())));
        assert_eq!(of("garment[0].panel.front.center"), Some(Subject::Panel("front".into())));
        assert_eq!(of("garment[0].fabric"), None, "it is the name of a fabric, and no fabric");
        assert_eq!(of("fabric.wool.file"), Some(Subject::Fabric("wool".into())));
        assert_eq!(of("time.step"), None);

        let pattern = Document::new("pattern.toml", "[[panel.front.outline]]\nname = \"hem\"");
        let of = |key: &str| pattern.at(key, "is wrong").subject;
        let edge = |edge: &str| Some(Subject::Edge { panel: "front".into(), edge: edge.into() });
        assert_eq!(of("panel.front.outline[0].to"), edge("hem"));
        assert_eq!(of("panel.front.outline[4]"), edge("5"));
        assert_eq!(of("panel.front.hems.side"), edge("side"));
        assert_eq!(of("seam.\"a.b\".sides"), Some(Subject::Seam("a.b".into())));
    }
}
