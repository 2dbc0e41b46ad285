//! Styles of a drawing, as far as they hide shapes: by attributes, by `style`, and by style sheets.
//!
//! A declaration of `style` counts before declarations of style sheets, the more specific rule
//! before the less specific rule, and an attribute last. `display` and `opacity` of a group hold
//! for all in it. `visibility`, `fill` and `stroke` are inherited unless an element states them.
//! `simplecss` reads and matches the rules of a style sheet.

use roxmltree::Node;
use simplecss::{
    AttributeOperator, Declaration, DeclarationTokenizer, Element, PseudoClass, StyleSheet,
};

/// Style sheets of a drawing.
pub(crate) struct Styles<'a> {
    sheet: StyleSheet<'a>,
}

/// Element of a drawing, as `simplecss` matches it with selectors.
struct StyledNode<'a, 'i>(Node<'a, 'i>);

impl Element for StyledNode<'_, '_> {
    fn parent_element(&self) -> Option<Self> {
        self.0.parent_element().map(Self)
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        self.0.prev_sibling_element().map(Self)
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.0.tag_name().name() == name
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        self.0.attribute(name).is_some_and(|value| operator.matches(value))
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        class == PseudoClass::FirstChild && self.0.prev_sibling_element().is_none()
    }
}

impl<'a> Styles<'a> {
    /// Returns the style sheets of the drawing `tree`.
    pub(crate) fn new(tree: &'a roxmltree::Document<'_>) -> Self {
        let mut sheet = StyleSheet::new();
        for node in tree.descendants().filter(|node| node.tag_name().name() == "style") {
            node.children().filter_map(|part| part.text()).for_each(|text| sheet.parse_more(text));
        }
        Self { sheet }
    }

    /// Returns whether the element `node` is drawn: neither it nor a group round it is hidden.
    pub(crate) fn shows(&self, node: Node<'_, '_>) -> bool {
        let is_hidden = node.ancestors().filter(Node::is_element).any(|n| {
            self.is(n, "display", |value| value == "none") || self.is(n, "opacity", is_zero)
        });
        let is_invisible =
            self.inherits(node, "visibility", |value| matches!(value, "hidden" | "collapse"));
        let has_paint = !self.has_no_paint(node, "fill") || !self.has_no_paint(node, "stroke");
        has_paint && !is_hidden && !is_invisible
    }

    /// Returns whether the styles of `node` state that it has no `paint`: `fill` or `stroke`.
    fn has_no_paint(&self, node: Node<'_, '_>, paint: &str) -> bool {
        self.inherits(node, paint, |value| matches!(value, "none" | "transparent"))
            || self.inherits(node, &format!("{paint}-opacity"), is_zero)
            || paint == "stroke" && self.inherits(node, "stroke-width", is_zero)
    }

    /// Returns whether the property `key` that `node` has or inherits fulfils the condition
    /// `holds`.
    fn inherits(&self, node: Node<'_, '_>, key: &str, holds: impl Fn(&str) -> bool) -> bool {
        let value = node.ancestors().filter(Node::is_element).find_map(|n| self.value(n, key));
        value.is_some_and(|value| holds(&value))
    }

    /// Returns whether the property `key` of `node` fulfils the condition `holds`.
    fn is(&self, node: Node<'_, '_>, key: &str, holds: impl Fn(&str) -> bool) -> bool {
        self.value(node, key).is_some_and(|value| holds(&value))
    }

    /// Returns the value of the property `key` of `node`, unless it is to be inherited.
    fn value(&self, node: Node<'_, '_>, key: &str) -> Option<String> {
        let rules = self.sheet.rules.iter().filter(|rule| rule.selector.matches(&StyledNode(node)));
        let inline = DeclarationTokenizer::from(node.attribute("style").unwrap_or_default());
        let declarations: Vec<Declaration<'_>> = rules
            .flat_map(|rule| rule.declarations.iter().copied())
            .chain(inline)
            .filter(|declaration| declaration.name.eq_ignore_ascii_case(key))
            .collect();

        // The last declaration counts, and important ones before others.
        let important = declarations.iter().rev().find(|declaration| declaration.important);
        let declared = important.or(declarations.last()).map(|declaration| declaration.value);
        let value = declared.or_else(|| node.attribute(key))?;
        let value = value.trim().to_ascii_lowercase();
        (value != "inherit").then_some(value)
    }
}

/// Returns whether `value`, a number with a unit or not, is zero.
fn is_zero(value: &str) -> bool {
    let number =
        value.trim_end_matches(|letter: char| letter == '%' || letter.is_ascii_alphabetic());
    number.parse::<f64>().is_ok_and(|number| number == 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_styles_and_style_sheets_hide_what_they_should() {
        let text = r#"<svg xmlns="http://www.w3.org/2000/svg">
<style>/* of a program */ @media print { .b { display: none } }
.a, g#layer > .c { display:none } path.d{visibility:hidden} .e{display:none} #over.e{display:inline}</style>
<style><![CDATA[ .f { opacity: 0 } .g { display: none !important; } ]]></style>
<path id="shown"/><path class="b" id="shown"/><path class="a" id="gone"/>
<g id="layer"><path class="c" id="gone"/><g><path class="c" id="shown"/></g></g>
<path class="d" id="gone"/><rect class="d" id="shown"/>
<path class="x e" id="gone"/><path class="e" id="over"/>
<g class="f"><path id="gone"/></g><path class="g" style="display:inline" id="gone"/>
<g display="none"><path style="display:inline" id="gone"/></g>
<g visibility="hidden"><path id="gone"/><path visibility="visible" id="shown"/></g>
<g style="VISIBILITY : collapse"><path id="gone"/></g>
<path opacity="0%" id="gone"/><path style="opacity:0.0" id="gone"/><path opacity="0.01" id="shown"/>
<g fill="none"><path id="shown"/><path stroke="none" id="gone"/><path stroke="none" fill="red" id="shown"/>
<path stroke-width="0px" id="gone"/><path style="stroke-opacity:0" id="gone"/></g>
</svg>"#;
        let tree = roxmltree::Document::parse(text).expect("it is XML");
        let styles = Styles::new(&tree);
        for node in
            tree.descendants().filter(|node| matches!(node.tag_name().name(), "path" | "rect"))
        {
            let expected = node.attribute("id") != Some("gone");
            assert_eq!(styles.shows(node), expected, "{}", &text[node.range()]);
        }
    }
}
