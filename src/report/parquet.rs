//! Tables as Apache Parquet: each column has the type that its name declares (text, truth, whole number or double), whatever a study fills it with; an empty cell is null. The metadata of the file hold the unit of each column that has
//! one, under `unit:COLUMN`. Compressed by Snappy.

use super::columns::{Kind, kind, unit};
use crate::analysis::campaign::{Cell, CellKind, Column};
use parquet::basic::{Compression, ConvertedType, Repetition, Type as Physical};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::column::writer::{ColumnWriter, ColumnWriterImpl};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

/// Rows that are held at a time.
const ROWS: usize = 100_000;

type Fault = Box<dyn std::error::Error + Send + Sync>;

/// A file of these columns without rows.
fn begun<W: Write + Send>(columns: &[(String, Kind)], out: W) -> Result<SerializedFileWriter<W>, ParquetError> {
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
    SerializedFileWriter::new(out, schema, Arc::new(properties))
}

/// Writes rows of cells; one that is not of the kind of its column is nothing.
///
/// # Errors
/// What prevents it.
pub(super) fn write_cells(columns: &[Column], rows: &[Vec<Cell>], out: &mut (impl Write + Send)) -> Result<(), Fault> {
    let kinds: Vec<(String, Kind)> = columns.iter().map(|c| (c.name.clone(), c.kind.into())).collect();
    let mut file = begun(&kinds, out)?;
    for rows in rows.chunks(ROWS) {
        let mut group = file.next_row_group()?;
        let mut column = 0;
        while let Some(mut writer) = group.next_column()? {
            let cells = || rows.iter().map(|r| &r[column]);
            match writer.untyped() {
                ColumnWriter::DoubleColumnWriter(w) => put(w, cells().map(|c| if let Cell::Number(x) = c { Some(*x) } else { None })),
                ColumnWriter::Int64ColumnWriter(w) => put(w, cells().map(|c| if let Cell::Count(n) = c { Some(*n) } else { None })),
                ColumnWriter::BoolColumnWriter(w) => put(w, cells().map(|c| if let Cell::Truth(t) = c { Some(*t) } else { None })),
                ColumnWriter::ByteArrayColumnWriter(w) => {
                    put(w, cells().map(|c| if let Cell::Text(t) = c { Some(ByteArray::from(t.as_str())) } else { None }))
                }
                _ => return Err("a column of another type".into()),
            }?;
            writer.close()?;
            column += 1;
        }
        group.close()?;
    }
    file.close()?;
    Ok(())
}

/// Writes the cells of a column, of which some are nothing.
fn put<T: DataType>(writer: &mut ColumnWriterImpl<'_, T>, cells: impl Iterator<Item = Option<T::T>>) -> Result<(), ParquetError> {
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    for cell in cells {
        levels.push(i16::from(cell.is_some()));
        values.extend(cell);
    }
    writer.write_batch(&values, Some(&levels), None).map(|_| ())
}

impl From<CellKind> for Kind {
    fn from(kind: CellKind) -> Self {
        match kind {
            CellKind::Text => Self::Text,
            CellKind::Truth => Self::Truth,
            CellKind::Count => Self::Count,
            CellKind::Number => Self::Number,
        }
    }
}

/// A column of a file, read back.
pub(super) enum ReadColumn {
    /// Numbers, whole ones and truths (0 and 1) with them; what is nothing is not a number.
    Numbers(Vec<f64>),
    /// Words.
    Words(Vec<Option<String>>),
}

/// Reads the columns of a file that [`write_cells`] wrote.
///
/// # Errors
/// What is wrong with the file.
pub(super) fn read_columns(path: &Path) -> Result<Vec<ReadColumn>, Fault> {
    let reader = SerializedFileReader::new(std::fs::File::open(path)?)?;
    let count = reader.metadata().file_metadata().schema().get_fields().len();
    let mut columns: Vec<ReadColumn> = Vec::new();
    for i in 0..count {
        let mut own = None;
        for group in 0..reader.num_row_groups() {
            let group = reader.get_row_group(group)?;
            let rows = usize::try_from(group.metadata().num_rows())?;
            let more = match group.get_column_reader(i)? {
                ColumnReader::DoubleColumnReader(mut r) => numbers(filled(&mut r, rows)?),
                ColumnReader::Int64ColumnReader(mut r) => numbers(filled(&mut r, rows)?.into_iter().map(|n| n.map(|n| n as f64)).collect()),
                ColumnReader::BoolColumnReader(mut r) => {
                    numbers(filled(&mut r, rows)?.into_iter().map(|t| t.map(|t| f64::from(u8::from(t)))).collect())
                }
                ColumnReader::ByteArrayColumnReader(mut r) => {
                    let text = |b: ByteArray| b.as_utf8().map(str::to_owned);
                    ReadColumn::Words(filled(&mut r, rows)?.into_iter().map(|b| b.map(text).transpose()).collect::<Result<_, _>>()?)
                }
                _ => return Err("a column of another type".into()),
            };
            match (&mut own, more) {
                (Some(ReadColumn::Numbers(all)), ReadColumn::Numbers(more)) => all.extend(more),
                (Some(ReadColumn::Words(all)), ReadColumn::Words(more)) => all.extend(more),
                (own, more) => *own = Some(more),
            }
        }
        columns.push(own.unwrap_or(ReadColumn::Numbers(Vec::new())));
    }
    Ok(columns)
}

fn numbers(values: Vec<Option<f64>>) -> ReadColumn {
    ReadColumn::Numbers(values.into_iter().map(|x| x.unwrap_or(f64::NAN)).collect())
}

/// The cells of a column of a group of rows.
fn filled<T: DataType>(reader: &mut ColumnReaderImpl<T>, rows: usize) -> Result<Vec<Option<T::T>>, ParquetError> {
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    reader.read_records(rows, Some(&mut levels), None, &mut values)?;
    let mut values = values.into_iter();
    Ok(levels.into_iter().map(|level| if level > 0 { values.next() } else { None }).collect())
}

/// Writes a table, from its `.csv`.
///
/// # Errors
/// What prevents it.
pub(super) fn convert(csv: &Path, out: &mut (impl Write + Send)) -> Result<(), Fault> {
    let columns = columns(csv)?;
    let mut file = begun(&columns, out)?;
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
