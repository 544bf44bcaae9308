//! Pictures of garments inside HTML pages.

use base64::Engine as _;
use toile_formats::picture::{View, Wishes, png};
use toile_formats::svg::canvas::escape;
use toile_garment::Garment;

/// A picture of a garment as a figure of an HTML page, in itself. `caption` is HTML. `None` where there is nothing to draw.
#[must_use]
pub fn figure(garment: &Garment, wishes: &Wishes<'_>, words: (&str, &str)) -> Option<String> {
    Some(png_figure(&png(garment, wishes).ok()?, words))
}

/// A PNG as a figure of an HTML page, in itself. `caption` is HTML.
#[must_use]
pub fn png_figure(png: &[u8], (alt, caption): (&str, &str)) -> String {
    let data = base64::engine::general_purpose::STANDARD.encode(png);
    let alt = escape(alt);
    format!(
        "<figure><img alt=\"{alt}\" src=\"data:image/png;base64,{data}\"><figcaption>{caption}</figcaption></figure>\n"
    )
}

/// One view of a garment on its body.
#[must_use]
pub fn one_view(view: View, [width, height]: [u32; 2]) -> Wishes<'static> {
    Wishes { views: vec![view], width, height, body: true, field: None }
}
