//! Tags in groups: each entity, section and block begins with a `0` tag.

use super::codes;
use super::findings::Findings;
use super::limits;
use super::tags::{Tag, Tags};
use toile_garment::Diagnostic;

/// A `0` tag and the tags up to the next one.
pub(crate) struct Group<'a> {
    pub head: Tag<'a>,
    pub tags: Vec<Tag<'a>>,
}

/// A file as groups.
pub(crate) struct Groups<'a> {
    pub tags: Tags<'a>,
    ahead: Option<Tag<'a>>,
    group: Group<'a>,
}

impl<'a> Groups<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        let none = Tag { code: 0, value: b"", line: 0 };
        Self { tags: Tags::new(bytes), ahead: None, group: Group { head: none, tags: Vec::new() } }
    }

    /// The next group; it lasts until the one after is asked for.
    pub(crate) fn next(&mut self, findings: &mut Findings) -> Result<Option<&Group<'a>>, Diagnostic> {
        let head = match self.ahead.take() {
            Some(tag) => Some(tag),
            None => self.tags.next(findings)?,
        };
        let Some(head) = head else { return Ok(None) };
        if head.code != 0 {
            let text = format!("group code {} stands outside any entity", head.code);
            return Err(Diagnostic::error(codes::STRAY_PAIR, text).at(findings.place(head.line)));
        }
        let tags = &mut self.group.tags;
        tags.clear();
        while let Some(tag) = self.tags.next(findings)? {
            if tag.code == 0 {
                self.ahead = Some(tag);
                break;
            }
            if tags.len() >= limits::PAIRS_PER_ENTITY {
                let text = format!("an entity of more than {} pairs", limits::PAIRS_PER_ENTITY);
                return Err(Diagnostic::error(codes::ENTITY_TOO_LARGE, text).at(findings.place(head.line)));
            }
            tags.push(tag);
        }
        self.group.head = head;
        Ok(Some(&self.group))
    }
}
