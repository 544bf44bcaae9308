//! Codes of the grammar of pipelines, and of checking a chain before it runs.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A product line, id, input or plugin has a name that cannot stand in file names and on the command line. Use
    /// lower-case letters, digits and hyphens, beginning with a letter, at most 64 characters.
    BAD_NAME = "bad-name";

    /// Two stages were given the same `id`. An id is what `--set id.key=value` speaks to, so each needs its own.
    DUPLICATE_ID = "duplicate-id";

    /// `toile = N` at the head of the pipeline says which grammar it is written in, and this program reads another one.
    /// Use the toile version the pipeline was made for, or write the pipeline anew.
    GRAMMAR_VERSION = "grammar-version";

    /// The pipeline declares an input that none of its texts names as `{name}`, so setting it does nothing. Write it
    /// where its value belongs, or leave it out.
    INPUT_UNUSED = "input-unused";

    /// The pipeline declares an input without default, and the call gave none. Add `--set name=value`.
    MISSING_INPUT = "missing-input";

    /// A key that must be there is not. The message names it; `toile stages NAME` lists a stage's parameters.
    MISSING_KEY = "missing-key";

    /// A text opens a name with `{` and does not close it. Write `{{` where a plain brace is meant.
    OPEN_BRACE = "open-brace";

    /// `{out}` stands for the output folder and can only stand at the beginning of a path: "{out}/name.glb".
    OUT_NOT_FIRST = "out-not-first";

    /// Two `--set` name the same input or parameter. The last one counts.
    SET_TWICE = "set-twice";

    /// The file is not TOML at this place. Texts stand in quotes, tables in [brackets], lists of tables in [[two
    /// brackets]].
    TOML_SYNTAX = "toml-syntax";

    /// `{name}` in a text is not a declared input. `{out}`, `{line}` and `{version}` are always there; a plain brace is
    /// written `{{`.
    UNKNOWN_INPUT = "unknown-input";

    /// An input is of kind text, path, number or length.
    UNKNOWN_KIND = "unknown-kind";

    /// `--set` names neither an input nor a stage's id.
    UNKNOWN_SET = "unknown-set";

    /// No stage has this name. `toile stages` lists them; one of another program needs [plugin.NAME].
    UNKNOWN_STAGE = "unknown-stage";

    /// A value is of another type than the key takes; quantities are texts with a unit, e.g. "8 mm".
    WRONG_TYPE = "wrong-type";
}
