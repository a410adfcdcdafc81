//! What the page is drawn with.

use std::fmt::Write;

/// What is drawn so far.
#[derive(Default)]
pub(super) struct Canvas {
    svg: String,
}

fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

impl Canvas {
    /// The whole picture.
    pub(super) fn svg(self, (width, height): (f64, f64)) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" font-family=\"DejaVu Sans\">\n<rect x=\"0\" y=\"0\" width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}</svg>",
            self.svg
        )
    }

    pub(super) fn text(&mut self, (x, y): (f64, f64), size: f64, words: &str, strong: bool) {
        self.anchored((x, y), size, words, (strong, "start"));
    }

    pub(super) fn anchored(&mut self, (x, y): (f64, f64), size: f64, words: &str, (strong, anchor): (bool, &str)) {
        // the built-in font has one weight: what is strong has a colour
        let fill = if strong { "#0b3d75" } else { "#1a1a1a" };
        let _ = writeln!(
            self.svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{fill}\">{}</text>",
            escaped(words)
        );
    }

    pub(super) fn line(&mut self, from: (f64, f64), to: (f64, f64), dashes: &str) {
        let dashed = if dashes.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dashes}\"") };
        let _ = writeln!(
            self.svg,
            "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#000000\" stroke-width=\"0.6\"{dashed}/>",
            from.0, from.1, to.0, to.1
        );
    }

    pub(super) fn rectangle(&mut self, (x, y, width, height): (f64, f64, f64, f64), fill: &str) {
        let _ = writeln!(
            self.svg,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"{fill}\" stroke=\"#000000\" stroke-width=\"0.8\"/>"
        );
    }

    /// A dimension between two points, level or upright, with its number beside it.
    pub(super) fn dimension(&mut self, from: (f64, f64), to: (f64, f64), words: &str) {
        self.line(from, to, "");
        let level = (from.1 - to.1).abs() < 0.5;
        for (x, y) in [from, to] {
            let (dx, dy) = if level { (0.0, 4.0) } else { (4.0, 0.0) };
            self.line((x - dx, y - dy), (x + dx, y + dy), "");
        }
        let middle = (0.5 * (from.0 + to.0), 0.5 * (from.1 + to.1));
        if level {
            self.anchored((middle.0, middle.1 - 4.0), 9.0, words, (false, "middle"));
        } else {
            let (x, y) = (middle.0 - 3.0, middle.1);
            let _ = writeln!(
                self.svg,
                "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" font-size=\"9\" text-anchor=\"middle\" fill=\"#000000\">{}</text>",
                escaped(words)
            );
        }
    }
}
