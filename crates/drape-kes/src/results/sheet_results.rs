//! Averaged values of one sheet of a file, by fabric.

use std::collections::BTreeSet;

use crate::results::average::{AssumedDirection, AveragedValue, average_fabric};
use crate::results::fabrics::split_by_fabric;
use crate::results::item::Item;
use crate::results::matrix::Matrix;
use crate::results::reading::readings;
use crate::results::table::read_table;
use crate::tables::grid::Grid;
use crate::tables::heading::is_bias;

/// Values that were read from a sheet, and notes on its entries that were left out.
#[derive(Clone, Debug, Default)]
pub(crate) struct SheetResults {
    /// Name of each fabric, where the table gives one, and its values.
    pub(crate) fabrics: Vec<(Option<String>, Vec<AveragedValue>)>,
    pub(crate) notes: Vec<String>,
}

/// Reads the values of a sheet `grid`.
///
/// Lines in `without`, such as lines of curves, are skipped. `assumed` is the direction that the
/// name of the sheet or the file gives, for tables that name none.
pub(crate) fn results(
    grid: &Grid,
    without: &BTreeSet<usize>,
    assumed: Option<&AssumedDirection>,
) -> SheetResults {
    let mut results = SheetResults::default();
    let entries = read_table(&Matrix::from_grid(grid, without));
    let mut readings = readings(entries, &mut results.notes);
    if is_at_45(grid) {
        for reading in readings.iter_mut().filter(|reading| reading.item == Item::Overhang) {
            reading.item = Item::SteepOverhang;
        }
    }
    // A mistake in a row is repeated for each number of the row.
    results.notes.dedup();

    if readings.is_empty() {
        return results;
    }
    for fabric in split_by_fabric(readings, &mut results.notes) {
        let values = average_fabric(&fabric.readings, assumed, &mut results.notes);
        results.fabrics.push((fabric.name, values));
    }
    results
}

/// Returns whether the sheet `grid` says that its cantilever is bent to 45°.
fn is_at_45(grid: &Grid) -> bool {
    let texts: Vec<String> = grid
        .rows
        .iter()
        .flat_map(|row| row.filled())
        .map(|(_, cell)| cell.text().to_lowercase())
        .collect();
    texts.iter().any(|text| is_bias(text))
        && texts.iter().any(|text| {
            ["cantilever", "カンチレバー", "1096", "悬臂"].iter().any(|word| text.contains(word))
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::grid::separator;
    use crate::test::Direction;

    fn of(text: &str) -> SheetResults {
        let rows = separator(text).split(text).expect("it splits");
        results(&Grid { rows, ..Grid::default() }, &BTreeSet::new(), None)
    }

    /// Returns a value of the only fabric, with its standard deviation.
    fn get(found: &SheetResults, key: &'static str, direction: Option<Direction>) -> (f64, f64) {
        let [(_, values)] = &found.fabrics[..] else { panic!("not one fabric: {found:?}") };
        let is_it =
            |value: &&AveragedValue| value.item == Item::Key(key) && value.direction == direction;
        let value = values.iter().find(is_it).unwrap_or_else(|| panic!("no {key}: {found:?}"));
        (value.number, value.deviation.unwrap_or(0.0))
    }

    const WARP: Option<Direction> = Some(Direction::Warp);
    const WEFT: Option<Direction> = Some(Direction::Weft);

    #[test]
    fn specimens_in_rows_and_in_columns_are_averaged() {
        let rows = "Item,Unit,Warp 1,Warp 2,Warp 3,Weft 1,Weft 2,Weft 3\n\
                    B,gf.cm2/cm,0.10,0.11,0.12,0.05,0.06,0.07\nW,mg/cm2,21,22,23,,,\n";
        let columns = "Specimen,B (gf.cm2/cm),W (mg/cm2)\nWarp 1,0.10,21\nWarp 2,0.11,22\nWarp 3,0.12,23\n\
                       Weft 1,0.05,\nWeft 2,0.06,\nWeft 3,0.07,\n";
        let long = "Direction,Specimen,Parameter,Value\nWarp,1,B,0.10\nWarp,2,B,0.11\nWarp,3,B,0.12\n\
                    Weft,1,B,0.05\nWeft,2,B,0.06\nWeft,3,B,0.07\n,1,W,21\n,2,W,22\n,3,W,23\n";
        for text in [rows, columns, long] {
            let found = of(text);
            assert_eq!(get(&found, "B", WARP), (0.11, 0.01), "{text}");
            assert_eq!(get(&found, "B", WEFT), (0.06, 0.01), "{text}");
            assert_eq!(get(&found, "W", None), (22.0, 1.0), "{text}");
            assert_eq!(found.notes, Vec::<String>::new(), "{text}");
        }
    }

    #[test]
    fn statistics_of_a_table_stand_beside_its_specimens() {
        let found =
            of("Item,Unit,1,2,3,Mean,SD,CV%\nWarp\nB,gf.cm2/cm,0.10,0.11,0.12,0.11,0.01,9.1\n\
                        Weft\nB,gf.cm2/cm,0.05,0.06,0.07,0.06,0.01,16.7\n");
        assert_eq!(get(&found, "B", WARP), (0.11, 0.01));
        assert_eq!(get(&found, "B", WEFT), (0.06, 0.01));
        let found = of("Item,Mean,SD\nB warp,0.11,0.02\nW,21.3,0.3\n");
        assert_eq!(get(&found, "B", WARP), (0.11, 0.02));
        assert_eq!(get(&found, "W", None), (21.3, 0.3));
        let found = of("Item,Mean (CV%)\nB warp,0.2 (5)\n");
        assert_eq!(get(&found, "B", WARP), (0.2, 0.01));
        // A mean that is not that of its specimens is told.
        let found = of("Item,1,2,Mean\nB warp,0.10,0.12,0.15\n");
        assert_eq!(get(&found, "B", WARP).0, 0.11);
        assert!(found.notes[0].contains("says B 0.15 for the mean"), "{:?}", found.notes);
    }

    #[test]
    fn a_second_table_of_the_same_items_is_not_mixed_with_the_first() {
        let found = of(
            "Before washing\nItem,Warp,Weft\nB,0.1,0.05\n\nAfter washing\nItem,Warp,Weft\nB,0.2,0.1\n",
        );
        assert_eq!(get(&found, "B", WARP).0, 0.1);
        assert!(found.notes[0].contains("more than once"), "{:?}", found.notes);
    }

    #[test]
    fn fabrics_across_and_below_each_other_are_told_apart() {
        let across = "Parameter,Unit,Cotton,,Wool,\n,,Warp,Weft,Warp,Weft\nB,gf.cm2/cm,0.1,0.05,0.3,0.2\n\
                      W,mg/cm2,12,,25,\n";
        let below = "Fabric,B warp,B weft,W\nCotton,0.1,0.05,12\nWool,0.3,0.2,25\n";
        let stacked = "Fabric: Cotton\nItem,Warp,Weft\nB,0.1,0.05\nW,12,\n\nFabric: Wool\nItem,Warp,Weft\n\
                       B,0.3,0.2\nW,25,\n";
        let long = "Fabric,Parameter,Direction,Value\nCotton,B,Warp,0.1\nCotton,B,Weft,0.05\nCotton,W,,12\n\
                    Wool,B,Warp,0.3\nWool,B,Weft,0.2\nWool,W,,25\n";
        for text in [across, below, stacked, long] {
            let found = of(text);
            let names: Vec<Option<&str>> =
                found.fabrics.iter().map(|(name, _)| name.as_deref()).collect();
            assert_eq!(names, [Some("Cotton"), Some("Wool")], "{text}: {found:?}");
            for ((_, values), wanted) in
                found.fabrics.iter().zip([[0.1, 0.05, 12.0], [0.3, 0.2, 25.0]])
            {
                let numbers: Vec<f64> = values.iter().map(|value| value.number).collect();
                assert_eq!(numbers, wanted, "{text}");
            }
        }
    }

    #[test]
    fn samples_are_specimens_where_they_agree_and_fabrics_where_they_do_not() {
        let alike = of("Sample,B warp,W\nS1,0.10,21\nS2,0.11,22\nS3,0.12,21.5\n");
        assert_eq!(get(&alike, "B", WARP), (0.11, 0.01));
        let apart = of("Sample,B warp,W\nS1,0.10,21\nS2,0.31,32\nS3,0.02,8\n");
        assert_eq!(apart.fabrics.len(), 3);
        for found in [alike, apart] {
            assert!(found.notes[0].starts_with("ASSUMED: S1 to S3 are"), "{:?}", found.notes);
        }
    }

    #[test]
    fn a_value_in_two_units_is_one_value() {
        let two =
            "Item,Unit,Warp,Weft,SI unit,Warp,Weft\nB,gf.cm2/cm,0.112,0.061,uN.m,10.98,5.98\n";
        let behind = "B warp,0.112,gf.cm2/cm,10.98,uN.m\nB weft,0.061,gf.cm2/cm,5.98,uN.m\n";
        for text in [two, behind] {
            let found = of(text);
            assert_eq!(get(&found, "B", WARP), (0.112, 0.0), "{text}");
            assert_eq!(get(&found, "B", WEFT), (0.061, 0.0), "{text}");
        }
    }

    #[test]
    fn fabrics_may_be_numbered_and_may_be_called_after_a_direction() {
        for text in [
            "Fabric,B warp,W\n1,0.10,21\n2,0.11,22\n",
            "Fabric,101,2044\nB warp,0.10,0.11\nW,21,22\n",
        ] {
            let found = of(text);
            assert_eq!(found.fabrics.len(), 2, "{text}: {found:?}");
        }
        let found = of("Fabric,B (warp),B (weft)\nWarp knit,0.10,0.05\nPlain weave,0.2,0.1\n");
        let names: Vec<Option<&str>> =
            found.fabrics.iter().map(|(name, _)| name.as_deref()).collect();
        assert_eq!(names, [Some("Warp knit"), Some("Plain weave")]);
    }

    #[test]
    fn values_of_other_tests_are_not_taken_for_those_of_kes() {
        let text = "Item,Warp,Weft\nB,0.1,0.05\nElongation at break (%),25,31\nMaximum elongation (%),24,30\n\
                    Static friction coefficient,0.4,0.5\nBending stiffness (N.mm2),0.4,0.5\n";
        let found = of(text);
        let [(_, values)] = &found.fabrics[..] else { panic!("{found:?}") };
        assert_eq!(values.len(), 2, "{values:?}");
        let notes = found.notes.join("\n");
        for words in
            ["\"Elongation at break (%)\" (line 3)", "\"Maximum elongation (%)\" (line 4)", "N.mm2"]
        {
            assert!(notes.contains(words), "{words} is missing in {notes}");
        }
    }

    #[test]
    fn what_is_no_value_is_told() {
        let found = of("Item,Unit,Warp,Weft,Limit\nB,gf.cm2/cm,0.1,n.d.,1\nG,Ohm/sq,0.7,0.6,1\n\
                        2HB,gf.cm/cm,2024-02-01,0.03,1\nGloss,%,40,42,1\n");
        assert_eq!(get(&found, "B", WARP).0, 0.1);
        let notes = found.notes.join("\n");
        for words in [
            "\"Limit\"",
            "\"Ohm/sq\" is no known unit of shear stiffness",
            "made a date",
            "\"Gloss\" (line 5)",
        ] {
            assert!(notes.contains(words), "{words} is missing in {notes}");
        }
    }
}
