//! Parts of an input that a mistake concerns, as data for programs that show them.

use crate::node::key_path::{KeyPart, key_parts};
use crate::node::{Node, Value};

/// Part of an input, identified by the name that the input gives it.
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
    /// Panel with this name.
    Panel(String),
    /// Edge of a panel.
    Edge {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
    },
    /// Seam with this name.
    Seam(String),
    /// Curve of a sheet, identified by its file.
    Curve(String),
    /// Body with this name.
    Body(String),
    /// Fabric with this name.
    Fabric(String),
}

impl Subject {
    /// Returns the names of the part, each with its kind, such as `("panel", "front")` and
    /// `("edge", "left")`.
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

    /// Returns the innermost part on the way from `root` along the key path `key`, if there is one.
    pub(crate) fn from_key(root: &Node, key: &str) -> Option<Self> {
        let path: Vec<KeyPart<'_>> = key_parts(key).collect();
        let mut subject = None;
        let mut node = Some(root);
        for (number, part) in path.iter().enumerate() {
            // In a table of tables the next key is the name. In a list of tables each has a `name`.
            let element = part.find(node);
            let next_key = path.get(number + 1);
            let name = element_text(element, "name");
            let inner = match (part.name, next_key, &part.indices[..]) {
                ("panel", Some(panel), []) => Some(Self::Panel(panel.name.to_owned())),
                ("panel", _, [_, ..]) => name.map(Self::Panel),
                ("seam", Some(seam), []) => Some(Self::Seam(seam.name.to_owned())),
                ("fabric", Some(fabric), []) => Some(Self::Fabric(fabric.name.to_owned())),
                ("curve", _, [_, ..]) => element_text(element, "file").map(Self::Curve),
                (kind, _, [index, ..]) if number > 0 && path[number - 1].name == "collider" => {
                    Some(Self::Body(name.unwrap_or_else(|| format!("{kind} {}", index + 1))))
                }
                ("outline", _, [index, ..]) => {
                    let edge = name.unwrap_or_else(|| (index + 1).to_string());
                    subject.as_ref().and_then(|panel: &Self| panel.edge(edge))
                }
                ("hems" | "split", Some(edge), []) => {
                    subject.as_ref().and_then(|panel| panel.edge(edge.name.to_owned()))
                }
                _ => None,
            };
            subject = inner.or(subject);
            node = element;
        }
        subject
    }

    /// Returns the edge `edge` of the panel, or `None` if the part is no panel.
    fn edge(&self, edge: String) -> Option<Self> {
        match self {
            Self::Panel(panel) => Some(Self::Edge { panel: panel.clone(), edge }),
            _ => None,
        }
    }
}

/// Returns the text at `key` in the table `element`, if there is one.
fn element_text(element: Option<&Node>, key: &str) -> Option<String> {
    element?.entry(key)?.node.as_text()
}

impl KeyPart<'_> {
    /// Returns the value to which the part of a key path leads from `node`.
    pub(crate) fn find<'a>(&self, node: Option<&'a Node>) -> Option<&'a Node> {
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
