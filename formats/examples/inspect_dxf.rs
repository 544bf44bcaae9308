//! Prints what is in a DXF as JSON: `inspect_dxf IN.dxf [OUT.json]`. Exit code 3 when the file is wrong.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::process::ExitCode;

fn main() -> ExitCode {
    let mut args = std::env::args().skip(1);
    let Some(input) = args.next() else {
        eprintln!("usage: inspect_dxf IN.dxf [OUT.json]");
        return ExitCode::from(2);
    };
    let output = args.next();
    let bytes = match std::fs::read(&input) {
        Ok(bytes) => bytes,
        Err(error) => {
            eprintln!("{input}: {error}");
            return ExitCode::from(5);
        }
    };
    let path = std::path::Path::new(&input);
    let rul = std::fs::read(path.with_extension("rul")).ok();
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    match toile_formats::dxf::inspect(&bytes, &name, rul.as_deref()) {
        Ok(inspection) => {
            let text = serde_json::to_string_pretty(&inspection.json).unwrap_or_default() + "\n";
            match output {
                Some(path) => {
                    if let Err(error) = std::fs::write(&path, text) {
                        eprintln!("{path}: {error}");
                        return ExitCode::from(5);
                    }
                }
                None => print!("{text}"),
            }
            ExitCode::SUCCESS
        }
        Err(findings) => {
            for finding in findings {
                eprintln!("{finding}");
            }
            ExitCode::from(3)
        }
    }
}
