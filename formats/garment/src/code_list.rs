//! The macro that lists codes of findings.
//!
//! Our packages take this file in by its path instead of importing the macro. The compiler reports dead code only where
//! the macro is of the same package. So it tells of a code that nothing gives, and of a list that nobody joins.

/// Lists the codes that a room gives. The first line names the list, and its visibility is that of all codes. The
/// documentation of a code is its meaning and its remedy.
#[macro_export]
macro_rules! codes {
    (
        $visible:vis list $list:ident;
        $(
            $(#[doc = $text:literal])+
            $constant:ident = $name:literal;
        )+
    ) => {
        $(
            $(#[doc = $text])+
            #[allow(clippy::disallowed_methods)]
            $visible const $constant: Code = Code::listed(stringify!($constant), $name, concat!($($text),+));
        )+

        // The list repeats the codes instead of naming them, so that a code that nothing gives stays dead code.
        /// All codes of this room.
        #[allow(clippy::disallowed_methods)]
        $visible const $list: &[Code] = &[$(Code::listed(stringify!($constant), $name, concat!($($text),+))),+];
    };
}
