//! Tables as Parquet: columns of numbers as doubles, other columns as text, empty cells as nulls.

use std::io::Error as IoError;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::error::Error;
use crate::table::{Column, Table};

impl Column {
    /// Returns whether each cell is a number or empty, and at least one cell is a number.
    fn is_numeric(&self) -> bool {
        let mut values = self.cells.iter().filter(|cell| !cell.is_empty()).peekable();
        values.peek().is_some() && values.all(|value| value.parse::<f64>().is_ok())
    }

    /// Returns the field of the column in the schema.
    fn field(&self) -> Result<Arc<Type>, ParquetError> {
        let field = if self.is_numeric() {
            Type::primitive_type_builder(&self.name, Physical::DOUBLE)
        } else {
            Type::primitive_type_builder(&self.name, Physical::BYTE_ARRAY)
                .with_logical_type(Some(LogicalType::String))
        };
        field.with_repetition(Repetition::OPTIONAL).build().map(Arc::new)
    }
}

impl Table {
    /// Returns the table as Parquet.
    ///
    /// # Errors
    /// [`Error::Io`] if the memory is exhausted.
    pub fn to_parquet(&self) -> Result<Vec<u8>, Error> {
        self.parquet()
            .map_err(|error| Error::io("write", Path::new("table.parquet"))(IoError::other(error)))
    }

    /// Returns the table as Parquet, or the error of the writer.
    fn parquet(&self) -> Result<Vec<u8>, ParquetError> {
        let fields = self.columns().map(Column::field).collect::<Result<_, _>>()?;
        let schema = Arc::new(Type::group_type_builder("table").with_fields(fields).build()?);
        let properties = Arc::new(WriterProperties::default());

        let mut bytes = Vec::new();
        let mut file = SerializedFileWriter::new(&mut bytes, schema, properties)?;
        let mut group = file.next_row_group()?;
        for column in self.columns() {
            // The definition level is 0 for a null and 1 for a value.
            let levels = column.cells.iter().map(|cell| i16::from(!cell.is_empty()));
            let levels: Vec<i16> = levels.collect();
            let cells = column.cells.iter().filter(|cell| !cell.is_empty());
            let Some(mut writer) = group.next_column()? else { break };
            if column.is_numeric() {
                let values: Vec<f64> = cells.filter_map(|cell| cell.parse().ok()).collect();
                writer.typed::<DoubleType>().write_batch(&values, Some(&levels), None)?;
            } else {
                let values: Vec<ByteArray> = cells.map(|cell| cell.as_str().into()).collect();
                writer.typed::<ByteArrayType>().write_batch(&values, Some(&levels), None)?;
            }
            writer.close()?;
        }
        group.close()?;
        file.close()?;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    use super::*;

    #[test]
    fn a_table_comes_back() {
        let column = |name: &str, cells: [&str; 3]| Column {
            name: name.into(),
            cells: cells.map(str::to_owned).to_vec(),
        };
        let table = Table {
            points: vec![column("point", ["0", "1", "2"]), column("key", ["1e5", "ab", "cd"])],
            inputs: vec![column("fabric", ["ü.toml", "b.toml", ""])],
            records: vec![column("message", ["", "", ""])],
            measures: vec![column("hem", ["0.25", "", "-1e-3"])],
        };
        let bytes = table.to_parquet().expect("written");
        let file = SerializedFileReader::new(bytes::Bytes::from(bytes)).expect("read");
        let rows = file.get_row_iter(None).expect("rows").map(|row| row.expect("a row"));
        let rows: Vec<Vec<(String, Field)>> = rows.map(|row| row.into_columns()).collect();
        let text = |text: &str| Field::Str(text.into());
        let named = |cells: [Field; 5]| {
            let names = ["point", "key", "fabric", "message", "hem"].map(str::to_owned);
            names.into_iter().zip(cells).collect::<Vec<_>>()
        };
        let number = Field::Double;
        assert_eq!(
            rows,
            [
                named([number(0.0), text("1e5"), text("ü.toml"), Field::Null, number(0.25)]),
                named([number(1.0), text("ab"), text("b.toml"), Field::Null, Field::Null]),
                named([number(2.0), text("cd"), Field::Null, Field::Null, number(-1e-3)]),
            ]
        );
    }
}
