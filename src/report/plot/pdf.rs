//! A picture as a page of PDF, its words as text.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::types::{CidFontType, FontFlags, LineCapStyle, LineJoinStyle, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str};
use resvg::tiny_skia::{PathSegment, Transform};
use resvg::usvg::{Fill, FillRule, Group, LineCap, LineJoin, Node, Paint, Path, Stroke, Text, Tree};
use std::collections::BTreeMap;
use std::io::Write;
use subsetter::Profile;
use ttf_parser::{Face, GlyphId};

/// Objects of the file; states of opacity follow.
const CATALOGUE: i32 = 1;
const PAGES: i32 = 2;
const PAGE: i32 = 3;
const CONTENT: i32 = 4;
const FONT: i32 = 5;
const CID_FONT: i32 = 6;
const DESCRIPTOR: i32 = 7;
const FONT_FILE: i32 = 8;
const TO_UNICODE: i32 = 9;
const FIRST_STATE: i32 = 10;

/// Glyphs of the built-in font by their number, with what they stand for.
type Glyphs = BTreeMap<u16, String>;

/// What is drawn so far.
struct Drawing {
    content: Content,
    glyphs: Glyphs,
    /// Opacities of fill and stroke, in 255ths.
    opacities: Vec<(u8, u8)>,
    units_per_em: f32,
}

/// A page of the size of the picture at so many of its units per inch; `None` of a picture with what plots do not have: gradients, images, clips, opacities of groups.
pub(super) fn pdf(tree: &Tree, units_per_inch: f32) -> Option<Vec<u8>> {
    let face = Face::parse(dejavu::sans::regular(), 0).ok()?;
    let (scale, size) = (72.0 / units_per_inch, tree.size());
    let (content, glyphs, opacities) = (Content::new(), Glyphs::new(), Vec::new());
    let mut drawing = Drawing { content, glyphs, opacities, units_per_em: f32::from(face.units_per_em()) };
    // PDF has its origin at the lower left corner
    drawing.content.transform([scale, 0.0, 0.0, -scale, 0.0, scale * size.height()]);
    drawing.group(tree.root(), 1.0)?;
    let mut pdf = Pdf::new();
    pdf.catalog(Ref::new(CATALOGUE)).pages(Ref::new(PAGES));
    pdf.pages(Ref::new(PAGES)).kids([Ref::new(PAGE)]).count(1);
    let mut page = pdf.page(Ref::new(PAGE));
    page.media_box(Rect::new(0.0, 0.0, scale * size.width(), scale * size.height()));
    page.parent(Ref::new(PAGES)).contents(Ref::new(CONTENT));
    let mut resources = page.resources();
    resources.fonts().pair(Name(b"F"), Ref::new(FONT));
    let mut states = resources.ext_g_states();
    let numbered = || (FIRST_STATE..).zip(&drawing.opacities);
    numbered().for_each(|(n, opacity)| {
        states.pair(Name(state(*opacity).as_bytes()), Ref::new(n));
    });
    states.finish();
    resources.finish();
    page.finish();
    for (n, (fill, stroke)) in numbered() {
        pdf.ext_graphics(Ref::new(n)).non_stroking_alpha(f32::from(*fill) / 255.0).stroking_alpha(f32::from(*stroke) / 255.0);
    }
    font(&mut pdf, &face, &drawing.glyphs)?;
    let content = compressed(&drawing.content.finish())?;
    pdf.stream(Ref::new(CONTENT), &content).filter(Filter::FlateDecode);
    Some(pdf.finish())
}

fn state((fill, stroke): (u8, u8)) -> String {
    format!("a{fill}_{stroke}")
}

fn compressed(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).ok()?;
    encoder.finish().ok()
}

/// Writes the built-in font with the glyphs that are used.
fn font(pdf: &mut Pdf, face: &Face, glyphs: &Glyphs) -> Option<()> {
    let name = Name(b"HARTOG+DejaVuSans");
    let system = SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };
    let per_em = 1000.0 / f32::from(face.units_per_em());
    pdf.type0_font(Ref::new(FONT))
        .base_font(name)
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(Ref::new(CID_FONT))
        .to_unicode(Ref::new(TO_UNICODE));
    let mut cid = pdf.cid_font(Ref::new(CID_FONT));
    cid.subtype(CidFontType::Type2).base_font(name).system_info(system).font_descriptor(Ref::new(DESCRIPTOR));
    cid.default_width(0.0).cid_to_gid_map_predefined(Name(b"Identity"));
    let mut widths = cid.widths();
    for glyph in glyphs.keys() {
        widths.consecutive(*glyph, [per_em * f32::from(face.glyph_hor_advance(GlyphId(*glyph)).unwrap_or(0))]);
    }
    widths.finish();
    cid.finish();
    let (bounds, ascent) = (face.global_bounding_box(), per_em * f32::from(face.ascender()));
    let [left, low, right, high] = [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(|x| per_em * f32::from(x));
    pdf.font_descriptor(Ref::new(DESCRIPTOR))
        .name(name)
        .flags(FontFlags::SYMBOLIC)
        .bbox(Rect::new(left, low, right, high))
        .italic_angle(0.0)
        .ascent(ascent)
        .descent(per_em * f32::from(face.descender()))
        .cap_height(face.capital_height().map_or(ascent, |h| per_em * f32::from(h)))
        .stem_v(95.0)
        .font_file2(Ref::new(FONT_FILE));
    let used: Vec<u16> = glyphs.keys().copied().collect();
    let subset = subsetter::subset(dejavu::sans::regular(), 0, Profile::pdf(&used)).ok()?;
    let file = compressed(&subset)?;
    pdf.stream(Ref::new(FONT_FILE), &file).filter(Filter::FlateDecode).pair(Name(b"Length1"), i32::try_from(subset.len()).ok()?);
    let mut meanings = UnicodeCmap::new(Name(b"Custom"), system);
    glyphs.iter().for_each(|(glyph, text)| meanings.pair_with_multiple(*glyph, text.chars()));
    pdf.cmap(Ref::new(TO_UNICODE), &meanings.finish());
    Some(())
}

impl Drawing {
    /// Draws a group. An opacity of its own is that of the one thing in it: what lies over each other would show through.
    fn group(&mut self, group: &Group, opacity: f32) -> Option<()> {
        let own = group.opacity().get();
        let is_plain = group.clip_path().is_none() && group.mask().is_none() && group.filters().is_empty();
        if !is_plain || (own != 1.0 && group.children().len() > 1) {
            return None;
        }
        group.children().iter().try_for_each(|node| match node {
            Node::Group(inner) => self.group(inner, opacity * own),
            Node::Path(path) => self.path(path, opacity * own),
            Node::Text(text) => self.text(text, opacity * own),
            Node::Image(_) => None,
        })
    }

    /// Colours of fill and stroke, and their opacities.
    fn colours(&mut self, fill: Option<&Fill>, stroke: Option<&Stroke>, opacity: f32) -> Option<()> {
        let colour =
            |paint: &Paint| if let Paint::Color(c) = paint { Some([c.red, c.green, c.blue].map(|x| f32::from(x) / 255.0)) } else { None };
        if let Some(fill) = fill {
            let [r, g, b] = colour(fill.paint())?;
            self.content.set_fill_rgb(r, g, b);
        }
        if let Some(stroke) = stroke {
            let [r, g, b] = colour(stroke.paint())?;
            self.content.set_stroke_rgb(r, g, b);
        }
        let opacity_byte = |own: Option<f32>| (255.0 * opacity * own.unwrap_or(1.0)).round() as u8;
        let opacities = (opacity_byte(fill.map(|f| f.opacity().get())), opacity_byte(stroke.map(|s| s.opacity().get())));
        if !self.opacities.contains(&opacities) {
            self.opacities.push(opacities);
        }
        self.content.set_parameters(Name(state(opacities).as_bytes()));
        Some(())
    }

    fn path(&mut self, path: &Path, opacity: f32) -> Option<()> {
        if !path.is_visible() {
            return Some(());
        }
        let (fill, stroke) = (path.fill(), path.stroke());
        self.content.save_state();
        self.colours(fill, stroke, opacity)?;
        self.content.transform(matrix(path.abs_transform()));
        if let Some(stroke) = stroke {
            self.content.set_line_width(stroke.width().get());
            self.content.set_line_cap(match stroke.linecap() {
                LineCap::Butt => LineCapStyle::ButtCap,
                LineCap::Round => LineCapStyle::RoundCap,
                LineCap::Square => LineCapStyle::ProjectingSquareCap,
            });
            self.content.set_line_join(match stroke.linejoin() {
                LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
                LineJoin::Round => LineJoinStyle::RoundJoin,
                LineJoin::Bevel => LineJoinStyle::BevelJoin,
            });
            self.content.set_miter_limit(stroke.miterlimit().get());
            if let Some(dashes) = stroke.dasharray() {
                self.content.set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
            }
        }
        self.outline(path);
        match (fill.map(Fill::rule), stroke) {
            (Some(FillRule::NonZero), Some(_)) => self.content.fill_nonzero_and_stroke(),
            (Some(FillRule::EvenOdd), Some(_)) => self.content.fill_even_odd_and_stroke(),
            (Some(FillRule::NonZero), None) => self.content.fill_nonzero(),
            (Some(FillRule::EvenOdd), None) => self.content.fill_even_odd(),
            (None, Some(_)) => self.content.stroke(),
            (None, None) => self.content.end_path(),
        };
        self.content.restore_state();
        Some(())
    }

    fn outline(&mut self, path: &Path) {
        let mut last = (0.0, 0.0);
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(p) => {
                    self.content.move_to(p.x, p.y);
                    last = (p.x, p.y);
                }
                PathSegment::LineTo(p) => {
                    self.content.line_to(p.x, p.y);
                    last = (p.x, p.y);
                }
                PathSegment::QuadTo(c, p) => {
                    // the same curve as a cubic one
                    let third = |a: f32, b: f32| a + 2.0 / 3.0 * (b - a);
                    self.content.cubic_to(third(last.0, c.x), third(last.1, c.y), third(p.x, c.x), third(p.y, c.y), p.x, p.y);
                    last = (p.x, p.y);
                }
                PathSegment::CubicTo(a, b, p) => {
                    self.content.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y);
                    last = (p.x, p.y);
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }

    fn text(&mut self, text: &Text, opacity: f32) -> Option<()> {
        for span in text.layouted().iter().filter(|s| s.visible) {
            if span.stroke.is_some() {
                return None;
            }
            self.content.save_state();
            self.colours(span.fill.as_ref(), None, opacity)?;
            self.content.begin_text().set_font(Name(b"F"), 1.0);
            for glyph in &span.positioned_glyphs {
                let number = u16::try_from(glyph.id.0).ok()?;
                let placed = text.abs_transform().pre_concat(glyph.outline_transform());
                self.content.set_text_matrix(matrix(placed.pre_scale(self.units_per_em, self.units_per_em)));
                self.content.show(Str(&number.to_be_bytes()));
                self.glyphs.entry(number).or_insert_with(|| glyph.text.clone());
            }
            self.content.end_text();
            self.content.restore_state();
        }
        Some(())
    }
}

fn matrix(t: Transform) -> [f32; 6] {
    [t.sx, t.ky, t.kx, t.sy, t.tx, t.ty]
}
