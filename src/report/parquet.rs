//! Tables as Apache Parquet: each column has the type that its name declares (text, truth, whole number or double), whatever a study fills it with; an empty cell is null. The metadata of the file hold the unit of each column that has
//! one, under `unit:COLUMN`. Compressed by Snappy.

use super::columns::{Kind, kind, unit};
use parquet::basic::{Compression, ConvertedType, Repetition, Type as Physical};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

/// Rows that are held at a time.
const ROWS: usize = 100_000;

type Fault = Box<dyn std::error::Error + Send + Sync>;

/// Writes a table, from its `.csv`.
///
/// # Errors
/// What prevents it.
pub(super) fn convert(csv: &Path, out: &mut (impl Write + Send)) -> Result<(), Fault> {
    let columns = columns(csv)?;
    let field = |(head, kind): &(String, Kind)| -> Result<Arc<Type>, ParquetError> {
        let (physical, converted) = match kind {
            Kind::Number => (Physical::DOUBLE, ConvertedType::NONE),
            Kind::Count => (Physical::INT64, ConvertedType::NONE),
            Kind::Truth => (Physical::BOOLEAN, ConvertedType::NONE),
            Kind::Text => (Physical::BYTE_ARRAY, ConvertedType::UTF8),
        };
        let field = Type::primitive_type_builder(head, physical).with_repetition(Repetition::OPTIONAL).with_converted_type(converted);
        Ok(Arc::new(field.build()?))
    };
    let fields = columns.iter().map(field).collect::<Result<Vec<_>, _>>()?;
    let schema = Arc::new(Type::group_type_builder("table").with_fields(fields).build()?);
    let in_unit = |(head, kind): &(String, Kind)| {
        let unit = unit(head).filter(|_| matches!(kind, Kind::Number | Kind::Count))?;
        Some(KeyValue::new(format!("unit:{head}"), unit.to_owned()))
    };
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(concat!("hartog ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_key_value_metadata(Some(columns.iter().filter_map(in_unit).collect()))
        .build();
    let mut file = SerializedFileWriter::new(out, schema, Arc::new(properties))?;
    let mut reader = csv::Reader::from_path(csv)?;
    let mut records = reader.records();
    loop {
        let rows = records.by_ref().take(ROWS).collect::<Result<Vec<_>, _>>()?;
        if rows.is_empty() {
            break;
        }
        let mut group = file.next_row_group()?;
        let mut column = 0;
        while let Some(mut writer) = group.next_column()? {
            let filled = || rows.iter().filter_map(|r| r.get(column)).filter(|cell| !cell.is_empty());
            let levels: Vec<i16> = rows.iter().map(|r| i16::from(r.get(column).is_some_and(|cell| !cell.is_empty()))).collect();
            let levels = Some(levels.as_slice());
            match writer.untyped() {
                ColumnWriter::DoubleColumnWriter(w) => w.write_batch(&parsed(filled())?, levels, None)?,
                ColumnWriter::Int64ColumnWriter(w) => w.write_batch(&parsed(filled())?, levels, None)?,
                ColumnWriter::BoolColumnWriter(w) => w.write_batch(&parsed(filled())?, levels, None)?,
                ColumnWriter::ByteArrayColumnWriter(w) => {
                    w.write_batch(&filled().map(ByteArray::from).collect::<Vec<_>>(), levels, None)?
                }
                _ => return Err("a column of another type".into()),
            };
            writer.close()?;
            column += 1;
        }
        group.close()?;
    }
    file.close()?;
    Ok(())
}

fn parsed<'c, T: std::str::FromStr>(cells: impl Iterator<Item = &'c str>) -> Result<Vec<T>, T::Err> {
    cells.map(str::parse).collect()
}

/// Whether a cell is of a kind.
fn is_of(cell: &str, kind: Kind) -> bool {
    match kind {
        Kind::Text => true,
        Kind::Truth => cell.parse::<bool>().is_ok(),
        Kind::Count => cell.parse::<i64>().is_ok(),
        Kind::Number => cell.parse::<f64>().is_ok(),
    }
}

/// Heads with what their columns hold; one with a cell of another kind than its name declares (a column that a user's table has named) is text, so that nothing is lost.
fn columns(csv: &Path) -> Result<Vec<(String, Kind)>, Fault> {
    let mut reader = csv::Reader::from_path(csv)?;
    let table = csv.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut columns: Vec<(String, Kind)> = reader.headers()?.iter().map(|head| (head.to_owned(), kind(&table, head))).collect();
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record)? {
        for ((_, kind), cell) in columns.iter_mut().zip(&record).filter(|(_, cell)| !cell.is_empty()) {
            if !is_of(cell, *kind) {
                *kind = Kind::Text;
            }
        }
    }
    Ok(columns)
}
