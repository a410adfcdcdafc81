//! A picture as PDF.

use std::sync::Arc;
use svg2pdf::usvg::{Options, Tree, fontdb::Database};
use svg2pdf::{ConversionOptions, PageOptions, to_pdf};

/// A page of the size of the picture at so many of its units per inch, its words as text; nothing where it cannot be drawn.
pub(super) fn pdf(svg: &str, units_per_inch: f32) -> Option<Vec<u8>> {
    let mut fonts = Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    let tree = Tree::from_str(svg, &Options { fontdb: Arc::new(fonts), ..Options::default() }).ok()?;
    to_pdf(&tree, ConversionOptions::default(), PageOptions { dpi: units_per_inch }).ok().map(|pdf| in_order(&pdf))
}

/// Entries of dictionaries of resources, a line each such as `/gs1 9 0 R`, in one order: svg2pdf writes them in that of a hash table. Nothing moves but lines of such a run.
fn in_order(pdf: &[u8]) -> Vec<u8> {
    let is_entry = |line: &&[u8]| {
        let line = line.trim_ascii();
        line.ends_with(b" 0 R") && [&b"/gs"[..], b"/xo", b"/po", b"/sh", b"/fo", b"/cs"].iter().any(|start| line.starts_with(start))
    };
    let mut lines: Vec<&[u8]> = pdf.split_inclusive(|b| *b == b'\n').collect();
    lines.chunk_by_mut(|a, b| is_entry(a) && is_entry(b)).for_each(<[&[u8]]>::sort);
    lines.concat()
}
