//! Comments on assumed numbers in the file of a fabric.

/// Table and key of a number in the file of a fabric, for the notes of a fit that concern the
/// number.
struct NoteTarget {
    /// Start of the note, after the direction.
    note: &'static str,
    /// Name of the table, with `D` for the direction.
    table: &'static str,
    /// Key in the table. Without a key the note concerns the whole table.
    key: Option<&'static str>,
}

/// Targets of the notes of a fit. A table of a direction exists once for warp and once for weft.
const NOTE_TARGETS: [NoteTarget; 16] = [
    NoteTarget { note: "density:", table: "", key: Some("density") },
    NoteTarget { note: "thickness:", table: "", key: Some("thickness") },
    NoteTarget { note: "surface_friction:", table: "", key: Some("surface_friction") },
    NoteTarget { note: "pressed_thickness:", table: "", key: Some("pressed_thickness") },
    NoteTarget { note: "compression_linearity:", table: "", key: Some("compression_linearity") },
    NoteTarget { note: "traction in compression:", table: "D.traction.buckling", key: None },
    NoteTarget { note: "traction friction:", table: "D.traction", key: None },
    NoteTarget { note: "traction:", table: "D.traction", key: None },
    NoteTarget {
        note: "bending friction length:",
        table: "D.bending.friction",
        key: Some("length"),
    },
    NoteTarget { note: "B:", table: "D.bending", key: Some("rigidity") },
    NoteTarget { note: "2HB:", table: "D.bending", key: None },
    NoteTarget { note: "bending:", table: "D.bending", key: None },
    NoteTarget { note: "shear friction length:", table: "shear.friction", key: Some("length") },
    NoteTarget { note: "shear stiffness:", table: "shear", key: Some("stiffness") },
    NoteTarget { note: "shear loop:", table: "shear.friction", key: Some("plateau") },
    NoteTarget { note: "shear beyond", table: "shear.locking", key: None },
];

/// Directions of the tables.
const DIRECTIONS: [&str; 2] = ["warp", "weft"];

/// Comment on a number or a table.
struct Comment<'a> {
    table: String,
    /// Key in the table, `None` for the table itself.
    key: Option<&'static str>,
    note: &'a str,
}

impl Comment<'_> {
    /// Returns whether the comment belongs above a line of `table`: the line of `key`, or, without
    /// a key, the heading of the table.
    fn belongs_above(&self, table: &str, key: Option<&str>) -> bool {
        let is_target_table = self.table == table;
        match self.key {
            Some(_) => is_target_table && key == self.key,
            None => {
                // A table without keys has no heading, but the first table within it has one.
                let rest = table.strip_prefix(self.table.as_str());
                let is_inner_table = rest.is_some_and(|rest| rest.starts_with('.'));
                key.is_none() && (is_target_table || is_inner_table)
            }
        }
    }
}

/// Returns `text`, the file of a fabric, with `notes` as comments above their numbers.
///
/// A note whose number is not in the file appears in the provenance alone.
pub(crate) fn annotated(text: &str, notes: &[String]) -> String {
    let mut comments: Vec<Comment<'_>> = notes.iter().flat_map(|note| comments_for(note)).collect();
    let mut annotated = String::with_capacity(text.len());
    let mut table = String::new();
    for line in text.lines() {
        let is_heading = line.starts_with('[');
        if is_heading {
            table = line.trim_matches(['[', ']']).to_owned();
        }

        // Each comment appears once, at the first line that it belongs to.
        let key = line.split_once(" = ").map(|(key, _)| key).filter(|_| !is_heading);
        let is_commentable = is_heading || key.is_some();
        comments.retain(|comment| {
            let belongs_here = is_commentable && comment.belongs_above(&table, key);
            if belongs_here {
                annotated.push_str("# assumed: ");
                annotated.push_str(comment.note);
                annotated.push('\n');
            }
            !belongs_here
        });
        annotated.push_str(line);
        annotated.push('\n');
    }
    annotated
}

/// Returns the comments for `note`: one, or one per direction if the note names none.
fn comments_for(note: &str) -> Vec<Comment<'_>> {
    let direction = DIRECTIONS
        .into_iter()
        .find(|name| note.strip_prefix(name).is_some_and(|rest| rest.starts_with(' ')));
    let statement = direction.map_or(note, |name| note[name.len()..].trim_start());
    let Some(target) = NOTE_TARGETS.iter().find(|target| statement.starts_with(target.note)) else {
        return Vec::new();
    };

    let directions = DIRECTIONS.into_iter().filter(|name| direction.is_none_or(|d| d == *name));
    let mut tables: Vec<String> = directions.map(|name| target.table.replace('D', name)).collect();
    tables.dedup();
    tables.into_iter().map(|table| Comment { table, key: target.key, note }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_note_stands_above_its_number() {
        let text = "density = 0.2\nthickness = 4e-4\n\n[warp.bending]\nrigidity = 1e-5\n\n\
                    [[warp.bending.friction]]\nplateau = 1e-3\nlength = 4\n\n[weft.traction.primed]\nk = 1\n";
        let notes = [
            "density: not measured, 0.2 kg/m² taken",
            "warp bending friction length: not in 2HB, 4 1/m taken",
            "weft traction: not measured, the warp's taken",
            "something else",
        ]
        .map(str::to_owned);
        let marked = annotated(text, &notes);
        for pair in [
            "# assumed: density: not measured, 0.2 kg/m² taken\ndensity = 0.2\n",
            "# assumed: warp bending friction length: not in 2HB, 4 1/m taken\nlength = 4\n",
            "# assumed: weft traction: not measured, the warp's taken\n[weft.traction.primed]\n",
        ] {
            assert!(marked.contains(pair), "{pair} is missing in\n{marked}");
        }
        let bare: Vec<&str> = marked.lines().filter(|line| !line.starts_with('#')).collect();
        assert_eq!(bare, text.lines().collect::<Vec<_>>(), "nothing else changes");
    }
}
