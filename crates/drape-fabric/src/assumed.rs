//! Comments in the file of a fabric on numbers that were assumed.

/// Place of a number in the file of a fabric: a table, and the key in it; without one the table itself.
struct Place {
    /// Start of the note, after the direction.
    note: &'static str,
    table: &'static str,
    key: Option<&'static str>,
}

/// Places of the notes of a fit; those in tables of a direction come once for each.
const PLACES: [Place; 16] = [
    Place { note: "density:", table: "", key: Some("density") },
    Place { note: "thickness:", table: "", key: Some("thickness") },
    Place { note: "surface_friction:", table: "", key: Some("surface_friction") },
    Place { note: "pressed_thickness:", table: "", key: Some("pressed_thickness") },
    Place { note: "compression_linearity:", table: "", key: Some("compression_linearity") },
    Place { note: "traction in compression:", table: "D.traction.buckling", key: None },
    Place { note: "traction friction:", table: "D.traction", key: None },
    Place { note: "traction:", table: "D.traction", key: None },
    Place { note: "bending friction length:", table: "D.bending.friction", key: Some("length") },
    Place { note: "B:", table: "D.bending", key: Some("rigidity") },
    Place { note: "2HB:", table: "D.bending", key: None },
    Place { note: "bending:", table: "D.bending", key: None },
    Place { note: "shear friction length:", table: "shear.friction", key: Some("length") },
    Place { note: "shear stiffness:", table: "shear", key: Some("stiffness") },
    Place { note: "shear loop:", table: "shear.friction", key: Some("plateau") },
    Place { note: "shear beyond", table: "shear.locking", key: None },
];

/// Directions of the tables.
const DIRECTIONS: [&str; 2] = ["warp", "weft"];

/// Returns the text of a file with the notes as comments at their numbers.
///
/// A note whose number is not in the file stands in the provenance alone.
pub(crate) fn marked(text: &str, notes: &[String]) -> String {
    let mut comments: Vec<(String, Option<&str>, &str)> = Vec::new();
    for note in notes {
        let direction = DIRECTIONS
            .into_iter()
            .find(|name| note.strip_prefix(name).is_some_and(|rest| rest.starts_with(' ')));
        let rest = direction.map_or(note.as_str(), |name| note[name.len()..].trim_start());
        let Some(place) = PLACES.iter().find(|place| rest.starts_with(place.note)) else {
            continue;
        };
        let tables = DIRECTIONS.into_iter().filter(|name| direction.is_none_or(|d| d == *name));
        let mut tables: Vec<String> = tables.map(|name| place.table.replace('D', name)).collect();
        tables.dedup();
        comments.extend(tables.into_iter().map(|table| (table, place.key, note.as_str())));
    }
    let mut marked = String::with_capacity(text.len());
    let mut table = String::new();
    for line in text.lines() {
        let head = line.starts_with('[').then(|| line.trim_matches(['[', ']']).to_owned());
        let key = line.split_once(" = ").map(|(key, _)| key);
        let is_head = head.is_some();
        if let Some(head) = head {
            table = head;
        }
        // A table may be there by those within it alone.
        comments.retain(|(of, wanted, note)| {
            let within = table.strip_prefix(of.as_str()).is_some_and(|r| r.starts_with('.'));
            let here = match wanted {
                Some(wanted) => *of == table && key == Some(wanted) && !is_head,
                None => is_head && (*of == table || within),
            };
            if here {
                marked.push_str("# assumed: ");
                marked.push_str(note);
                marked.push('\n');
            }
            !here
        });
        marked.push_str(line);
        marked.push('\n');
    }
    marked
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
        let marked = marked(text, &notes);
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
