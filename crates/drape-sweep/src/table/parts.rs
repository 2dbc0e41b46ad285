//! Parts of a table: those of shards, collected on their own and joined.

use std::collections::BTreeSet;
use std::path::Path;

use crate::error::Error;
use crate::study::Study;
use crate::table::{Column, RECORDS, Table};

impl Table {
    /// Reads the table of a study, or of a shard of it, from the text of [`to_csv`](Self::to_csv);
    /// the path is that of messages.
    ///
    /// # Errors
    /// The text is no table of this study.
    pub fn from_csv(study: &Study, path: &Path, text: &[u8]) -> Result<Self, Error> {
        let failed = |error: csv::Error| Error::io("read", path)(error.into());
        let mut csv = csv::Reader::from_reader(text);
        let names = csv.headers().map_err(failed)?;
        let named = |name: &str| Column { name: name.to_owned(), cells: Vec::new() };
        let mut columns: Vec<Column> = names.iter().map(named).collect();
        for row in csv.records() {
            let row = row.map_err(failed)?;
            columns.iter_mut().zip(&row).for_each(|(own, cell)| own.cells.push(cell.to_owned()));
        }
        let own = ["point", "key"].into_iter();
        let inputs = study.axes().map(|axis| axis.name.as_str());
        let expected: Vec<&str> = own.chain(inputs).chain(RECORDS).collect();
        let found = columns.iter().map(|column| column.name.as_str());
        if !found.take(expected.len()).eq(expected.iter().copied()) {
            let message = "its columns are not those of the study; collect its shards anew";
            return Err(Error::io("use", path)(std::io::Error::other(message)));
        }
        let measures = columns.split_off(expected.len());
        let records = columns.split_off(expected.len() - RECORDS.len());
        let inputs = columns.split_off(2);
        Ok(Self { points: columns, inputs, records, measures })
    }

    /// Joins the tables of shards: rows in the order of the plan, all measures that one of them has.
    /// Returns the table, and the number of points that are in none of them.
    #[must_use]
    pub fn join(study: &Study, parts: &[Self]) -> (Self, usize) {
        let mut places: Vec<(usize, usize, usize)> = Vec::new();
        for (part, table) in parts.iter().enumerate() {
            let numbers = table.points.first().map_or(&[][..], |column| &column.cells[..]);
            let numbers = numbers.iter().enumerate();
            places.extend(numbers.filter_map(|(row, n)| Some((n.parse().ok()?, part, row))));
        }
        places.sort_unstable();
        places.dedup_by_key(|place| place.0);
        let missing = study.point_count().saturating_sub(places.len());
        let pick = |column: &dyn Fn(&Self) -> Option<&Column>, name: &str| {
            let cells: Vec<Option<&Column>> = parts.iter().map(column).collect();
            let cell = |&(_, part, row): &(usize, usize, usize)| {
                cells[part].map_or(String::new(), |column| column.cells[row].clone())
            };
            Column { name: name.to_owned(), cells: places.iter().map(cell).collect() }
        };
        let fixed = |columns: fn(&Self) -> &Vec<Column>| -> Vec<Column> {
            let Some(first) = parts.first() else { return Vec::new() };
            let own = columns(first).iter().enumerate();
            own.map(|(index, own)| pick(&|part| columns(part).get(index), &own.name)).collect()
        };
        let mut known = BTreeSet::new();
        let named = parts.iter().flat_map(|part| &part.measures).map(|column| &column.name);
        let mut names: Vec<&String> = named.filter(|name| known.insert(*name)).collect();
        if study.measures().is_empty() {
            names.sort();
        }
        let of_name = |name: &String| {
            pick(&|part| part.measures.iter().find(|column| column.name == *name), name)
        };
        let table = Self {
            points: fixed(|part| &part.points),
            inputs: fixed(|part| &part.inputs),
            records: fixed(|part| &part.records),
            measures: names.into_iter().map(of_name).collect(),
        };
        (table, missing)
    }
}
