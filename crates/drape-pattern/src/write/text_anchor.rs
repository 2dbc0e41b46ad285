//! Anchor of a text beside a line of a drawing.

/// Returns the `text-anchor` of a text beside a line, so that the text does not run over the line.
/// `inward` is the x component of the unit vector from the line to the text.
pub(crate) fn text_anchor(inward: f64) -> &'static str {
    match inward {
        0.5.. => "start",
        ..-0.5 => "end",
        _ => "middle",
    }
}
