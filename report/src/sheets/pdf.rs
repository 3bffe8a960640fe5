//! All sheets as one PDF: vectors, true to scale, with the request that readers print without scaling.

use std::f64::consts::TAU;

use pdf_writer::types::{CidFontType, FontFlags, SystemInfo};
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, Str};

use super::drawing::{DIGIT, Page, Shape};

/// Points of 1/72 inch in a millimetre.
const POINTS: f64 = 72.0 / 25.4;
const LATIN: Name = Name(b"F");
const KOREAN: Name = Name(b"K");
/// A Gothic that readers replace by their own, as they do Helvetica: nothing is embedded.
const GOTHIC: &[u8] = b"HYGoThic-Medium";

/// The file.
pub fn pdf(pages: &[Page]) -> Vec<u8> {
    let (catalog, tree, latin, korean) = (Ref::new(1), Ref::new(2), Ref::new(3), Ref::new(4));
    let page_at = |k: usize| Ref::new(7 + 2 * k as i32);
    let content_at = |k: usize| Ref::new(8 + 2 * k as i32);
    let mut pdf = Pdf::new();
    let mut root = pdf.catalog(catalog);
    root.pages(tree);
    root.viewer_preferences().pair(Name(b"PrintScaling"), Name(b"None"));
    root.finish();
    pdf.pages(tree).kids((0..pages.len()).map(page_at)).count(pages.len() as i32);
    pdf.type1_font(latin).base_font(Name(b"Helvetica")).encoding_predefined(Name(b"WinAnsiEncoding"));
    korean_font(&mut pdf, [korean, Ref::new(5), Ref::new(6)]);
    for (k, page) in pages.iter().enumerate() {
        let [width, height] = page.size.map(|side| (side * POINTS) as f32);
        let mut own = pdf.page(page_at(k));
        own.parent(tree).media_box(Rect::new(0.0, 0.0, width, height)).contents(content_at(k));
        own.resources().fonts().pair(LATIN, latin).pair(KOREAN, korean);
        own.finish();
        pdf.stream(content_at(k), &content(page));
    }
    pdf.finish()
}

/// The operators of a page, in millimetres from its top left corner.
fn content(page: &Page) -> Vec<u8> {
    let mut content = Content::new();
    let scale = POINTS as f32;
    content.transform([scale, 0.0, 0.0, -scale, 0.0, (page.size[1] * POINTS) as f32]);
    for shape in &page.shapes {
        match shape {
            Shape::Rect { at, size, grey } => {
                content.set_fill_gray(*grey as f32);
                content.rect(at[0] as f32, at[1] as f32, size[0] as f32, size[1] as f32).fill_nonzero();
            }
            Shape::Disc { at, radius, grey } => {
                content.set_fill_gray(*grey as f32);
                let start = polar(*at, *radius, 0.0);
                content.move_to(start[0], start[1]);
                arc(&mut content, *at, *radius, [0.0, 1.0]);
                content.close_path().fill_nonzero();
            }
            Shape::Sector { at, radii: [inner, outer], turns, grey } => {
                content.set_fill_gray(*grey as f32);
                let start = polar(*at, *outer, turns[0]);
                content.move_to(start[0], start[1]);
                arc(&mut content, *at, *outer, *turns);
                let inwards = polar(*at, *inner, turns[1]);
                content.line_to(inwards[0], inwards[1]);
                arc(&mut content, *at, *inner, [turns[1], turns[0]]);
                content.close_path().fill_nonzero();
            }
            Shape::Line { ends: [a, b], width } => {
                content.set_stroke_gray(0.0).set_line_width(*width as f32);
                content.move_to(a[0] as f32, a[1] as f32).line_to(b[0] as f32, b[1] as f32).stroke();
            }
            Shape::Text { at, size, middle, text } => {
                let back = if *middle { DIGIT * size * text.len() as f64 / 2.0 } else { 0.0 };
                content.set_fill_gray(0.0).begin_text();
                content.set_text_matrix([1.0, 0.0, 0.0, -1.0, (at[0] - back) as f32, at[1] as f32]);
                for (latin, bytes) in runs(text) {
                    content.set_font(if latin { LATIN } else { KOREAN }, *size as f32).show(Str(&bytes));
                }
                content.end_text();
            }
        }
    }
    content.finish().to_vec()
}

/// A font of Korea's character set by its name, its characters given as UTF-16: the font itself, its glyphs, what it looks like.
fn korean_font(pdf: &mut Pdf, [font, glyphs, looks]: [Ref; 3]) {
    pdf.type0_font(font)
        .base_font(Name(&[GOTHIC, b"-UniKS-UTF16-H"].concat()))
        .encoding_predefined(Name(b"UniKS-UTF16-H"))
        .descendant_font(glyphs);
    pdf.cid_font(glyphs)
        .subtype(CidFontType::Type0)
        .base_font(Name(GOTHIC))
        .system_info(SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Korea1"), supplement: 1 })
        .font_descriptor(looks)
        .default_width(1000.0);
    pdf.font_descriptor(looks)
        .name(Name(GOTHIC))
        .flags(FontFlags::SYMBOLIC)
        .bbox(Rect::new(-6.0, -145.0, 1003.0, 880.0))
        .italic_angle(0.0)
        .ascent(752.0)
        .descent(-271.0)
        .cap_height(737.0)
        .stem_v(58.0);
}

/// Parts of a text that a font has: Latin-1, which beyond its controls is the same in WinAnsi, and everything else as UTF-16.
fn runs(text: &str) -> Vec<(bool, Vec<u8>)> {
    let mut runs: Vec<(bool, Vec<u8>)> = Vec::new();
    for c in text.chars() {
        let latin = u8::try_from(u32::from(c)).ok();
        if runs.last().is_none_or(|(last, _)| *last != latin.is_some()) {
            runs.push((latin.is_some(), Vec::new()));
        }
        let Some((_, bytes)) = runs.last_mut() else { continue };
        match latin {
            Some(byte) => bytes.push(byte),
            None => bytes.extend(c.encode_utf16(&mut [0; 2]).iter().flat_map(|unit| unit.to_be_bytes())),
        }
    }
    runs
}

fn polar(at: [f64; 2], radius: f64, turn: f64) -> [f32; 2] {
    let (s, c) = (TAU * turn).sin_cos();
    [(at[0] + radius * c) as f32, (at[1] + radius * s) as f32]
}

/// An arc from where the path stands, in pieces of at most an eighth of a turn: a cubic with handles of 4/3·tan(α/4) is off by 4e-6
/// of the radius there.
fn arc(content: &mut Content, at: [f64; 2], radius: f64, turns: [f64; 2]) {
    let pieces = ((turns[1] - turns[0]).abs() * 8.0 - 1e-9).ceil().max(1.0) as usize;
    let step = (turns[1] - turns[0]) / pieces as f64;
    let handle = 4.0 / 3.0 * (TAU * step / 4.0).tan() * radius;
    for piece in 0..pieces {
        let [from, to] = [piece, piece + 1].map(|k| turns[0] + step * k as f64);
        let [first, second] = [(from, handle), (to, -handle)].map(|(turn, handle)| {
            let (s, c) = (TAU * turn).sin_cos();
            [(at[0] + radius * c - handle * s) as f32, (at[1] + radius * s + handle * c) as f32]
        });
        let end = polar(at, radius, to);
        content.cubic_to(first[0], first[1], second[0], second[1], end[0], end[1]);
    }
}
