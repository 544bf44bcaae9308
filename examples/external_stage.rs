//! A stage in another process: protocol 2 in full. Declare it in a pipeline and allow it on the command line:
//!
//! ```toml
//! [plugin.acme]
//! command = ["path/to/external_stage"]
//!
//! [[stage]]
//! use = "acme.set-material"
//! with.piece = "front"
//! with.material = "lining"
//! ```
//!
//! `toile run pipeline.toml --allow-run acme`

use serde::Deserialize;
use serde_json::{Value, json};
use std::io::{Read as _, Write as _};
use std::process::ExitCode;
use toile::external::{Description, PROTOCOL, Request, StageDescription};
use toile_garment::bundle::{FILE_NAME, from_text, to_text};
use toile_garment::{Aspect, Code, Diagnostic, Garment};

toile_garment::codes! {
    pub(crate) list CODES;

    /// The material of a piece was set.
    MATERIAL_SET = "material-set";

    /// The garment has no piece of this name. The hint lists the pieces.
    UNKNOWN_PIECE = "unknown-piece";
}

const STAGE: &str = "acme.set-material";

#[derive(Deserialize)]
struct Params {
    piece: String,
    material: String,
}

fn main() -> ExitCode {
    match std::env::args().nth(1).as_deref() {
        Some("describe") => describe(),
        Some("forecast") => end(forecast()),
        Some("run") => end(work()),
        _ => {
            eprint("usage: external_stage describe | forecast | run");
            ExitCode::from(1)
        }
    }
}

fn describe() -> ExitCode {
    let params_schema = json!({
        "type": "object",
        "required": ["piece", "material"],
        "additionalProperties": false,
        "properties": {
            "piece": { "type": "string", "description": "Name of the piece." },
            "material": { "type": "string", "description": "Material it is cut from." }
        }
    });
    let stage = StageDescription {
        name: STAGE.to_owned(),
        summary: "sets the material of one piece".to_owned(),
        needs: vec![Aspect::Pieces],
        gives: Vec::new(),
        revision: 1,
        params_schema,
        // It has no parameter that an accuracy could set.
        knobs: Vec::new(),
        forecast: true,
    };
    print(&json!(Description { protocol: PROTOCOL, stages: vec![stage] }));
    ExitCode::SUCCESS
}

fn end(done: Result<(), Failure>) -> ExitCode {
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::Rejected(finding)) => {
            print_line("diagnostic", &json!(finding));
            ExitCode::from(2)
        }
        Err(Failure::Broken(message)) => {
            eprint(&message);
            ExitCode::from(1)
        }
    }
}

enum Failure {
    Rejected(Box<Diagnostic>),
    Broken(String),
}

fn broken(error: impl std::fmt::Display) -> Failure {
    Failure::Broken(error.to_string())
}

/// The request and the garment that lies in its input folder.
fn asked() -> Result<(Request, Garment), Failure> {
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).map_err(broken)?;
    let request: Request = serde_json::from_str(&text).map_err(broken)?;
    if request.protocol != PROTOCOL || request.stage != STAGE {
        return Err(Failure::Broken(format!("cannot do `{}` of protocol {}", request.stage, request.protocol)));
    }
    let bundle = std::fs::read_to_string(request.input.join(FILE_NAME)).map_err(broken)?;
    let garment = from_text(&bundle).map_err(broken)?;
    Ok((request, garment))
}

/// It starts a process and goes through the pieces once.
fn forecast() -> Result<(), Failure> {
    let (_, garment) = asked()?;
    let seconds = 0.01 + 1e-6 * garment.pieces.len() as f64;
    print_line("forecast", &json!({ "seconds": seconds, "mb": 4.0 }));
    Ok(())
}

fn work() -> Result<(), Failure> {
    let (request, mut garment) = asked()?;
    let params: Params = serde_json::from_value(request.params).map_err(broken)?;
    print_line("progress", &json!({ "done": 0, "total": 1, "words": "setting the material" }));
    set_material(&mut garment, params)?;
    let text = to_text(&garment).map_err(broken)?;
    std::fs::write(request.output.join(FILE_NAME), text).map_err(broken)
}

fn set_material(garment: &mut Garment, params: Params) -> Result<(), Failure> {
    let names: Vec<String> = garment.pieces.iter().map(|p| p.name.clone()).collect();
    let piece = garment.pieces.iter_mut().find(|p| p.name == params.piece).ok_or_else(|| {
        let finding = Diagnostic::error(UNKNOWN_PIECE, format!("there is no piece `{}`", params.piece));
        Failure::Rejected(Box::new(finding.hint(format!("the pieces are {}", names.join(", ")))))
    })?;
    let old = piece.material.replace(params.material.clone()).unwrap_or_else(|| "none".to_owned());
    let message = format!("the material of `{}` was {old} and is now {}", params.piece, params.material);
    print_line("diagnostic", &json!(Diagnostic::info(MATERIAL_SET, message)));
    Ok(())
}

fn print_line(kind: &str, body: &Value) {
    let mut line = body.clone();
    if let Some(map) = line.as_object_mut() {
        map.insert("kind".to_owned(), json!(kind));
    }
    print(&line);
}

fn print(value: &Value) {
    // Nobody listening is the engine's affair.
    drop(writeln!(std::io::stdout(), "{value}"));
}

fn eprint(text: &str) {
    drop(writeln!(std::io::stderr(), "{text}"));
}
