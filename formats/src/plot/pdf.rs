//! The sheet as PDF at 1:1: on one page of its own size, or in tiles on paper, with marks to join them.

use super::codes;
use super::{Layer, Sheet};
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str};
use toile_garment::{Diagnostic, Vec2};

/// Points per millimetre.
const POINT: f64 = 72.0 / 25.4;
/// Blank margin of a tile, mm: printers do not reach it.
const MARGIN: f64 = 10.0;
/// Arms of the marks at the corners of a tile, mm.
const MARK: f64 = 5.0;
/// How hard pages are packed, of 10.
const PACKING: u8 = 6;
/// Most pages.
const PAGES: usize = 5_000;
/// Largest page of PDF, mm (200 inches).
const LARGEST: f64 = 5_080.0;

/// Paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paper {
    /// One page as large as the sheet.
    Sheet,
    /// Tiles of this size, mm.
    Tiles(Vec2),
}

impl Paper {
    /// `sheet`, or a format by its name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let (w, h) = match name.trim().to_ascii_lowercase().as_str() {
            "sheet" => return Some(Self::Sheet),
            "a0" => (841.0, 1189.0),
            "a1" => (594.0, 841.0),
            "a2" => (420.0, 594.0),
            "a3" => (297.0, 420.0),
            "a4" => (210.0, 297.0),
            "letter" => (215.9, 279.4),
            _ => return None,
        };
        Some(Self::Tiles(Vec2::new(w, h)))
    }
}

/// The part of the sheet that one page shows.
struct Tile {
    /// Lower left corner of what is shown, mm.
    from: Vec2,
    /// Size of what is shown, mm.
    size: Vec2,
    /// Row from the top and column, from 0; none when the page is the whole sheet.
    place: Option<(usize, usize)>,
}

/// The file; the same sheet gives the same bytes.
///
/// # Errors
/// More pages than a person can join, or a sheet larger than a page can be.
pub fn pdf(sheet: &Sheet, paper: Paper, title: &str) -> Result<(Vec<u8>, Vec<Diagnostic>), Diagnostic> {
    let (page, tiles) = tiles(sheet, paper)?;
    let mut pdf = Pdf::new();
    let [catalog, tree, font, info] = [1, 2, 3, 4].map(Ref::new);
    let id = |k: usize, part: i32| Ref::new(5 + 2 * k as i32 + part);
    pdf.catalog(catalog).pages(tree);
    pdf.pages(tree).kids((0..tiles.len()).map(|k| id(k, 0))).count(tiles.len() as i32);
    pdf.document_info(info).title(pdf_writer::TextStr(title));
    let mut lost = false;
    for (k, tile) in tiles.iter().enumerate() {
        let mut one = pdf.page(id(k, 0));
        one.media_box(Rect::new(0.0, 0.0, (page.x * POINT) as f32, (page.y * POINT) as f32));
        one.parent(tree).contents(id(k, 1));
        one.resources().fonts().pair(Name(b"F"), font);
        one.finish();
        let content = draw(sheet, tile, page, &mut lost);
        let packed = compress_to_vec_zlib(&content.finish(), PACKING);
        pdf.stream(id(k, 1), &packed).filter(Filter::FlateDecode);
    }
    pdf.type1_font(font).base_font(Name(b"Helvetica")).encoding_predefined(Name(b"WinAnsiEncoding"));
    let mut findings = Vec::new();
    if lost {
        let text = "letters that are not Latin are written as `?` in the PDF";
        findings.push(
            Diagnostic::info(codes::TEXT_NOT_LATIN, text).hint("SVG holds all of them; with a `font` they are drawn"),
        );
    }
    Ok((pdf.finish(), findings))
}

/// Size of the page and what each shows, rows from the top.
fn tiles(sheet: &Sheet, paper: Paper) -> Result<(Vec2, Vec<Tile>), Diagnostic> {
    let size = sheet.size;
    let Paper::Tiles(page) = paper else {
        if size.x.max(size.y) > LARGEST {
            let text = format!("a page of {:.0} × {:.0} mm is larger than PDF allows", size.x, size.y);
            return Err(Diagnostic::error(codes::SHEET_TOO_LARGE, text).hint("choose a paper to tile it on"));
        }
        return Ok((size, vec![Tile { from: Vec2::zeros(), size, place: None }]));
    };
    let shown = page - Vec2::new(2.0 * MARGIN, 2.0 * MARGIN);
    let count = |whole: f64, one: f64| libm::ceil(whole / one - 1e-9).max(1.0) as usize;
    let (columns, rows) = (count(size.x, shown.x), count(size.y, shown.y));
    if columns.saturating_mul(rows) > PAGES {
        let text = format!("{columns} × {rows} pages; at most {PAGES} are written");
        return Err(Diagnostic::error(codes::SHEET_TOO_LARGE, text).hint("choose a larger paper"));
    }
    let mut out = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let from = Vec2::new(column as f64 * shown.x, (rows - 1 - row) as f64 * shown.y);
            out.push(Tile { from, size: shown, place: Some((row, column)) });
        }
    }
    Ok((page, out))
}

fn draw(sheet: &Sheet, tile: &Tile, page: Vec2, lost: &mut bool) -> Content {
    let mut content = Content::new();
    let corner = (page - tile.size) * 0.5;
    let at = |p: Vec2| {
        let q = (p - tile.from + corner) * POINT;
        (q.x as f32, q.y as f32)
    };
    content.save_state();
    if tile.place.is_some() {
        let (x, y) = at(tile.from);
        content.rect(x, y, (tile.size.x * POINT) as f32, (tile.size.y * POINT) as f32);
        content.clip_nonzero().end_path();
    }
    for layer in Layer::ALL {
        content.set_line_width((layer.width() * POINT) as f32);
        content.set_dash_pattern(layer.dashes().iter().map(|d| (d * POINT) as f32), 0.0);
        for stroke in sheet.on(layer).filter(|s| touches(&s.points, tile)) {
            trace(&mut content, &stroke.points, stroke.closed, &at);
            content.stroke();
        }
    }
    for letters in sheet.letters.iter().filter(|l| l.iter().any(|r| touches(r, tile))) {
        letters.iter().for_each(|ring| trace(&mut content, ring, true, &at));
        content.fill_nonzero();
    }
    for label in &sheet.labels {
        let width = 0.5 * label.height * label.text.chars().count() as f64;
        text(&mut content, at(label.at - Vec2::new(0.5 * width, 0.0)), label.height, &label.text, lost);
    }
    content.restore_state();
    if let Some((row, column)) = tile.place {
        marks(&mut content, tile, &at);
        let name = format!("row {}, column {}", row + 1, column + 1);
        text(&mut content, at(tile.from + Vec2::new(MARK + 2.0, -MARGIN + 4.0)), 3.0, &name, lost);
    }
    content
}

/// The path of a line.
fn trace(content: &mut Content, points: &[Vec2], closed: bool, at: &dyn Fn(Vec2) -> (f32, f32)) {
    for (k, p) in points.iter().enumerate() {
        let (x, y) = at(*p);
        if k == 0 {
            content.move_to(x, y)
        } else {
            content.line_to(x, y)
        };
    }
    if closed {
        content.close_path();
    }
}

/// Could a line show on a tile?
fn touches(points: &[Vec2], tile: &Tile) -> bool {
    let (lo, hi) = (tile.from.add_scalar(-2.0), (tile.from + tile.size).add_scalar(2.0));
    let below = |k: usize| points.iter().all(|p| p[k] < lo[k]);
    let above = |k: usize| points.iter().all(|p| p[k] > hi[k]);
    !(below(0) || below(1) || above(0) || above(1))
}

/// Crosses at the corners: those of neighbouring tiles are laid on each other.
fn marks(content: &mut Content, tile: &Tile, at: &dyn Fn(Vec2) -> (f32, f32)) {
    content.set_line_width((0.2 * POINT) as f32);
    content.set_dash_pattern([], 0.0);
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
        let c = tile.from + Vec2::new(tile.size.x * x, tile.size.y * y);
        for arm in [Vec2::new(MARK, 0.0), Vec2::new(0.0, MARK)] {
            let (a, b) = (at(c - arm), at(c + arm));
            content.move_to(a.0, a.1).line_to(b.0, b.1).stroke();
        }
    }
}

/// A line of Helvetica; its letters are those of Windows-1252.
fn text(content: &mut Content, (x, y): (f32, f32), height: f64, text: &str, lost: &mut bool) {
    let (bytes, _, unmapped) = encoding_rs::WINDOWS_1252.encode(text);
    let bytes = if unmapped {
        *lost = true;
        let folded: String = text
            .chars()
            .map(|c| if encoding_rs::WINDOWS_1252.encode(c.encode_utf8(&mut [0; 4])).2 { '?' } else { c })
            .collect();
        encoding_rs::WINDOWS_1252.encode(&folded).0.into_owned()
    } else {
        bytes.into_owned()
    };
    content.begin_text().set_font(Name(b"F"), (height * POINT) as f32);
    content.next_line(x, y).show(Str(&bytes)).end_text();
}
