//! Tables as Apache Parquet: columns of numbers are doubles, others text; an empty cell is null. Compressed by Snappy.

use parquet::basic::{Compression, ConvertedType, Repetition, Type as Physical};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
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
    let (heads, numeric) = columns(csv)?;
    let field = |(head, numeric): (&String, &bool)| -> Result<Arc<Type>, ParquetError> {
        let (physical, converted) =
            if *numeric { (Physical::DOUBLE, ConvertedType::NONE) } else { (Physical::BYTE_ARRAY, ConvertedType::UTF8) };
        let field = Type::primitive_type_builder(head, physical).with_repetition(Repetition::OPTIONAL).with_converted_type(converted);
        Ok(Arc::new(field.build()?))
    };
    let fields = heads.iter().zip(&numeric).map(field).collect::<Result<Vec<_>, _>>()?;
    let schema = Arc::new(Type::group_type_builder("table").with_fields(fields).build()?);
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(concat!("hartog ", env!("CARGO_PKG_VERSION")).to_owned())
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
            match writer.untyped() {
                ColumnWriter::DoubleColumnWriter(w) => {
                    let values = filled().map(str::parse).collect::<Result<Vec<f64>, _>>()?;
                    w.write_batch(&values, Some(&levels), None)?;
                }
                ColumnWriter::ByteArrayColumnWriter(w) => {
                    let values: Vec<ByteArray> = filled().map(ByteArray::from).collect();
                    w.write_batch(&values, Some(&levels), None)?;
                }
                _ => return Err("a column of another type".into()),
            }
            writer.close()?;
            column += 1;
        }
        group.close()?;
    }
    file.close()?;
    Ok(())
}

/// Heads, and whether every cell that is filled is a number, of which there is one at least.
fn columns(csv: &Path) -> Result<(Vec<String>, Vec<bool>), Fault> {
    let mut reader = csv::Reader::from_path(csv)?;
    let heads: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
    let (mut numbers, mut words) = (vec![false; heads.len()], vec![false; heads.len()]);
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record)? {
        for (i, cell) in record.iter().enumerate().filter(|(i, cell)| *i < heads.len() && !cell.is_empty()) {
            let kind = if cell.parse::<f64>().is_ok() { &mut numbers } else { &mut words };
            kind[i] = true;
        }
    }
    Ok((heads, numbers.iter().zip(&words).map(|(n, w)| *n && !w).collect()))
}
