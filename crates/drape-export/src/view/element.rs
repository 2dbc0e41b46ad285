//! Element of a page that holds data for the viewer's script.

use serde_json::Value;

/// Returns the element of a page that holds a value as JSON.
pub(super) fn json_element(id: &str, value: &Value) -> String {
    // No text can end the element that holds it.
    let text = value.to_string().replace('<', "\\u003c");
    format!("<script type=\"application/json\" id=\"{id}\">{text}</script>\n")
}
