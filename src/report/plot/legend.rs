//! Legends, below what they explain, so that they cover no curve and none is cut off.

use super::canvas::{Area, Drawn, Stroke, px, text};
use plotters::prelude::*;

/// What stands before a label.
#[derive(Clone, Copy)]
pub(crate) enum Mark {
    /// A line.
    Curve(Stroke),
    /// A point.
    Point(ShapeStyle),
    /// A box.
    Block(ShapeStyle),
    /// Nothing: a note.
    Note,
}

/// A line of a legend.
#[derive(Clone)]
pub(crate) struct Entry {
    label: String,
    mark: Mark,
}

impl Entry {
    pub fn new(label: impl Into<String>, mark: Mark) -> Self {
        Self { label: label.into(), mark }
    }

    pub fn curve(label: impl Into<String>, stroke: Stroke) -> Self {
        Self::new(label, Mark::Curve(stroke))
    }
}

/// Distance of lines, length of a mark and width of a letter, units.
const APART: u32 = 19;
const MARK: u32 = 30;
const LETTER: f64 = 6.9;
/// Room at the sides, units.
const SIDE: u32 = 16;

fn columns(entries: &[Entry], width: u32) -> u32 {
    let longest = entries.iter().map(|e| e.label.chars().count()).max().unwrap_or(0);
    let each = SIDE + MARK + (LETTER * longest as f64) as u32;
    ((width - SIDE) / each.max(1)).clamp(1, entries.len().max(1) as u32)
}

/// Height of a legend below something of a width, units.
pub(crate) fn height(entries: &[Entry], width: u32) -> u32 {
    6 + APART * (entries.len() as u32).div_ceil(columns(entries, width))
}

/// Draws a legend at the bottom of an area and gives the area above it.
pub(crate) fn below<'a>(area: &Area<'a>, entries: &[Entry]) -> Result<Area<'a>, Box<dyn std::error::Error>> {
    let (width, all) = area.dim_in_pixel();
    let width = width / px(1);
    let (main, bottom) = area.split_vertically(all - px(height(entries, width)));
    draw(&bottom, entries, width)?;
    Ok(main)
}

fn draw(area: &Area, entries: &[Entry], width: u32) -> Drawn {
    let columns = columns(entries, width);
    let rows = (entries.len() as u32).div_ceil(columns);
    let pixels = |x: u32, y: u32| (px(x) as i32, px(y) as i32);
    for (i, entry) in (0u32..).zip(entries) {
        let (x, y) = (SIDE + i / rows * ((width - SIDE) / columns), 4 + APART * (i % rows) + APART / 2);
        let label = match entry.mark {
            Mark::Note => x,
            _ => x + MARK,
        };
        match entry.mark {
            Mark::Curve(Stroke { style, dash: None }) => {
                area.draw(&PathElement::new(vec![pixels(x, y), pixels(x + MARK - 6, y)], style))?
            }
            Mark::Curve(Stroke { style, dash: Some((dash, gap)) }) => {
                for from in (x..x + MARK - 6).step_by((dash + gap) as usize) {
                    area.draw(&PathElement::new(vec![pixels(from, y), pixels((from + dash).min(x + MARK - 6), y)], style))?;
                }
            }
            Mark::Point(style) => area.draw(&Circle::new(pixels(x + (MARK - 6) / 2, y), px(4), style))?,
            Mark::Block(style) => area.draw(&Rectangle::new([pixels(x, y - 5), pixels(x + MARK - 6, y + 5)], style))?,
            Mark::Note => {}
        }
        area.draw(&Text::new(entry.label.clone(), pixels(label, y - 7), text(13)))?;
    }
    Ok(())
}
