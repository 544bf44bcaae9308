//! Codes of the engine and the command line.

use super::{Code, code};

/// Codes of the engine, in alphabetical order.
pub(super) const CODES: &[Code] = &[
    code(
        "accuracy-chosen",
        "What `accuracy` of the pipeline's head, or --accuracy, was taken to mean: the setting, and its error. The error is estimated by a study of this garment where one lies beside the pipeline (`toile study`), else it is what the preset promises.",
    ),
    code(
        "accuracy-no-stage",
        "An accuracy chooses the mesh and the drape together, so the chain must have `triangulate` and `drape`. For a mesh from a file, `with.accuracy` of `drape` says how near to rest it is led. Exit code 2.",
    ),
    code(
        "accuracy-out-of-reach",
        "Nothing that is known is as exact as asked. `toile study` measures finer meshes of this garment; its study.json, put beside the pipeline as NAME.study.json, is then chosen from. Exit code 2.",
    ),
    code(
        "bad-name",
        "A product line, id, input or plugin has a name that cannot stand in file names and on the command line.\nUse lower-case letters, digits and hyphens, beginning with a letter, at most 64 characters.",
    ),
    code(
        "certificate-failed",
        "The drape was computed and written, but a figure of its certificate is beyond its limit, so the result should not be relied on. Exit code 1.\n`certificate` in run.json holds each figure and `limits` what was asked. Crossings often come from pieces placed inside the body; large strain from a garment too small for the body or a wrong unit.",
    ),
    code(
        "duplicate-id",
        "Two stages were given the same `id`. An id is what `--set id.key=value` speaks to, so each needs its own.",
    ),
    code(
        "file-missing",
        "A file that the pipeline names is not there. Paths are relative to the pipeline file, not to the folder the command is run in. Exit code 3.",
    ),
    code(
        "grammar-version",
        "`toile = N` at the head of the pipeline says which grammar it is written in, and this program reads another one. Use the toile version the pipeline was made for, or write the pipeline anew.",
    ),
    code(
        "internal-error",
        "A mistake of the program itself, caught before it could damage anything. Exit code 5. Please report it with the pipeline and the message.",
    ),
    code("limit", "Something is larger than the program takes on; the message names the limit. Exit code 3."),
    code(
        "missing-input",
        "The pipeline declares an input without default, and the call gave none. Add `--set name=value`.",
    ),
    code(
        "missing-key",
        "A key that must be there is not. The message names it; `toile stages NAME` lists a stage's parameters.",
    ),
    code(
        "needs-not-given",
        "A stage needs something that no stage before it gives, e.g. `drape` before `stitch`. Stages run in the order they are written.",
    ),
    code("no-reader", "The file's form is not one that this verb reads."),
    code("not-text", "The file is not UTF-8 text. Save it as UTF-8."),
    code("open-brace", "A text opens a name with `{` and does not close it. Write `{{` where a plain brace is meant."),
    code(
        "out-not-first",
        "`{out}` stands for the output folder and can only stand at the beginning of a path: \"{out}/name.glb\".",
    ),
    code(
        "outputs-collide",
        "Two outputs of one run have the same name (upper and lower case are not told apart). Give each its own.",
    ),
    code(
        "path-refused",
        "A path leads where a pipeline may not go: out of its project, to a device, or over a file that is there already. Paths are relative to the pipeline file and stay in its project (the nearest folder upwards with .git, toile.root or Cargo.toml). `--allow-read DIR` and `--allow-write DIR` widen that, `--force` replaces files. Exit code 2.",
    ),
    code(
        "plugin-failed",
        "The program behind a plugin's stage ended with an error, took too long or wrote too much. What it said on stderr is in the message.",
    ),
    code(
        "plugin-needs-consent",
        "A pipeline names a program of its own. It is never run on the word of a file alone: if you trust it, pass `--allow-run NAME`. Exit code 2.",
    ),
    code(
        "plugin-protocol",
        "The program behind a plugin does not keep to protocol 1. Run it by hand with the argument `describe`; see `external` in ARCHITECTURE.md.",
    ),
    code("plugin-rejected", "The program behind a plugin's stage did not accept the garment."),
    code(
        "set-form",
        "An override must read `--set name=value` for an input or `--set stage-id.key=value` for a parameter.",
    ),
    code(
        "study-empty",
        "No setting of the study gave a drape, so nothing can be compared. `toile run` with the same pipeline says why. Exit code 4.",
    ),
    code(
        "study-held",
        "A --set holds a parameter that the study varies: all its rows would be the same. Leave it out. Exit code 2.",
    ),
    code("study-no-drape", "A study compares drapes, and the chain has none. Exit code 2."),
    code(
        "study-unfit",
        "The study beside the pipeline cannot be used, so the accuracy comes from the presets: it is damaged, of another version, or of another pipeline. Make it anew with `toile study`.",
    ),
    code(
        "toml-syntax",
        "The file is not TOML at this place. Texts stand in quotes, tables in [brackets], lists of tables in [[two brackets]].",
    ),
    code(
        "unknown-input",
        "`{name}` in a text is not a declared input. `{out}`, `{line}` and `{version}` are always there; a plain brace is written `{{`.",
    ),
    code("unknown-kind", "An input is of kind text, path, number or length."),
    code(
        "unknown-measure",
        "`toile body --set` names a measure that a body does not have. `toile body` without options lists them.",
    ),
    code("unknown-set", "`--set` names neither an input nor a stage's id."),
    code(
        "unknown-stage",
        "No stage has this name. `toile stages` lists them; one of another program needs [plugin.NAME].",
    ),
    code("unknown-value", "A parameter takes one of a few words, and this is none of them."),
    code("unstable", "The solver did not converge or became unstable. Exit code 4."),
    code("unsupported", "The file is right, but the program cannot do this yet. Exit code 3."),
    code(
        "write-failed",
        "An output could not be written: disk full, no rights, or the folder is gone. Nothing half-written is left. Exit code 5.",
    ),
    code(
        "wrong-type",
        "A value is of another type than the key takes; quantities are texts with a unit, e.g. \"8 mm\".",
    ),
    code(
        "wrong-value",
        "A parameter's value cannot be read. Quantities are texts with a number and a unit, e.g. \"8 mm\"; a bare number is refused because it hides its unit.",
    ),
];
