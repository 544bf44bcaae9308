//! The page of a watched pipeline: it holds the report of the last run in a frame and loads it anew after every run.
//! It asks for a small script again and again, since a page from the disk may load scripts and nothing else.

use crate::engine::write_whole;
use std::io::Result;
use std::path::Path;

/// Name of the page in the output folder.
pub const PAGE_NAME: &str = "watch.html";
/// Name of the script that tells the last run.
const SCRIPT_NAME: &str = "watch.js";

const PAGE: &str = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>toile watch</title>\n\
    <style>body{margin:0}iframe{border:0;width:100vw;height:100vh;display:block}</style>\n</head>\n\
    <body data-toile-watch=\"1\">\n<iframe title=\"the last run\"></iframe>\n<script>\n'use strict';\n\
    let last = 0;\n\
    window.toileRun = (number, page) => {\n\
    \x20 if (number === last) return;\n\
    \x20 last = number;\n\
    \x20 document.querySelector('iframe').src = `${page}?run=${number}`;\n\
    };\n\
    setInterval(() => {\n\
    \x20 const script = document.createElement('script');\n\
    \x20 script.src = `watch.js?at=${Date.now()}`;\n\
    \x20 script.onload = script.onerror = () => script.remove();\n\
    \x20 document.head.append(script);\n\
    }, 500);\n</script>\n</body>\n</html>\n";

/// Shows a page of the output folder as that of the run with this number.
///
/// # Errors
/// When the disk refuses.
pub fn show(folder: &Path, number: usize, page: &str) -> Result<()> {
    write_whole(&folder.join(PAGE_NAME), PAGE.as_bytes())?;
    let page = serde_json::Value::from(page);
    write_whole(&folder.join(SCRIPT_NAME), format!("window.toileRun({number}, {page});\n").as_bytes())
}
