//! Bytes of a table as UTF-8: UTF-16 is known by its mark, and single lines that are no UTF-8 are those of Windows-1252, as Excel saves tables in Western Europe.

use std::io::{BufRead, BufReader, Cursor, Error, ErrorKind, Read};

/// Characters of the bytes 0x80 to 0x9f of Windows-1252; from 0xa0 it is latin-1 (ISO 8859-1), and both are Unicode. Source: Unicode, `CP1252.TXT`.
const HIGH: [char; 32] = [
    '€', '\0', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\0', 'Ž', '\0', '\0', '‘', '’', '“', '”', '•', '–', '—', '˜', '™',
    'š', '›', 'œ', '\0', 'ž', 'Ÿ',
];

/// A line in Windows-1252; None where a byte stands for no character of a text.
pub(super) fn windows_1252(line: &[u8]) -> Option<String> {
    let character = |byte: &u8| match *byte {
        b'\t' | b'\r' | b'\n' => Some(char::from(*byte)),
        0..=0x1f | 0x7f => None,
        0x80..=0x9f => Some(HIGH[usize::from(byte - 0x80)]).filter(|c| *c != '\0'),
        other => Some(char::from(other)),
    };
    line.iter().map(character).collect()
}

/// What a file is that is no text, by its first bytes.
pub(super) fn other_kind(start: &[u8]) -> Option<&'static str> {
    const KINDS: [(&[u8], &str); 4] = [
        (b"PK\x03\x04", "a workbook or archive"),
        (b"\xd0\xcf\x11\xe0", "a workbook of an old Excel"),
        (b"%PDF", "a PDF document"),
        (b"\x1f\x8b", "a packed file"),
    ];
    KINDS.iter().find(|k| start.starts_with(k.0)).map(|k| k.1)
}

/// The same text in UTF-8 where it begins with the mark of UTF-16, without the mark of UTF-8; all else as it is.
///
/// # Errors
/// Where it cannot be read.
pub(super) fn utf8<'a>(mut bytes: impl Read + Send + 'a) -> std::io::Result<Box<dyn BufRead + Send + 'a>> {
    let mut start = Vec::new();
    bytes.by_ref().take(3).read_to_end(&mut start)?;
    Ok(match start.as_slice() {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => {
            let is_big_endian = start[0] == 0xfe;
            let rest = Cursor::new(start[2..].to_vec()).chain(bytes);
            Box::new(BufReader::new(Utf16 { bytes: BufReader::new(rest), is_big_endian, ready: Cursor::default() }))
        }
        [0xef, 0xbb, 0xbf] => Box::new(BufReader::new(bytes)),
        _ => Box::new(BufReader::new(Cursor::new(start).chain(bytes))),
    })
}

/// Reads UTF-16 as UTF-8.
struct Utf16<R> {
    bytes: R,
    is_big_endian: bool,
    /// Read, not given yet.
    ready: Cursor<Vec<u8>>,
}

impl<R: Read> Utf16<R> {
    /// The next unit; None at the end.
    fn unit(&mut self) -> std::io::Result<Option<u16>> {
        let mut pair = Vec::new();
        self.bytes.by_ref().take(2).read_to_end(&mut pair)?;
        match pair.as_slice() {
            [] => Ok(None),
            [a, b] => Ok(Some(if self.is_big_endian { u16::from_be_bytes([*a, *b]) } else { u16::from_le_bytes([*a, *b]) })),
            _ => Err(Error::new(ErrorKind::InvalidData, "half a character of UTF-16 at its end")),
        }
    }
}

impl<R: Read> Read for Utf16<R> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        const UNITS: usize = 4096;
        if self.ready.position() as usize == self.ready.get_ref().len() {
            let mut units = Vec::new();
            while let Some(unit) = self.unit()? {
                units.push(unit);
                // a pair of surrogates stays together
                if units.len() >= UNITS && !(0xd800..0xdc00).contains(&unit) {
                    break;
                }
            }
            let text = String::from_utf16(&units).map_err(|_| Error::new(ErrorKind::InvalidData, "half a character of UTF-16"))?;
            self.ready = Cursor::new(text.into_bytes());
        }
        self.ready.read(into)
    }
}
