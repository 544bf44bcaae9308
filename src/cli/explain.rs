//! `toile explain CODE`

use super::args::ExplainArgs;
use super::console::Console;
use crate::codes;
use crate::engine::Exit;
use crate::pipeline::remedy_of_many;

pub(super) fn run(args: &ExplainArgs, console: &mut Console<'_>) -> Exit {
    let Some(name) = &args.code else {
        for code in codes::all() {
            console.result(&format!("{}\n", code.name()));
        }
        return Exit::Good;
    };
    if let Some(code) = codes::find(name) {
        console.result(&format!("{}\n\n{}\n", code.name(), code.text()));
        return Exit::Good;
    }
    let all = codes::all();
    let hint = remedy_of_many(name, all.iter().map(|c| c.name()));
    console.say(&format!(
        "there is no code `{}`\n  help: {hint}; `toile explain` lists all codes\n",
        crate::render::safe(name)
    ));
    Exit::Usage
}
