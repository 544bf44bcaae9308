//! Tuned numbers and mechanisms of the sparse factorisation.

use crate::tuning::{mechanisms, tuned};

tuned! {
    room "linear";

    /// Unknowns from which a system is ordered by nested dissection; smaller ones are ordered by least degree.
    DISSECTION_UNKNOWNS_MIN: usize = 3_000, {
        unit: "unknown vertices",
        larger: "Systems of a few thousand unknowns take up to a third more sums.",
        smaller: "Small systems take up to a half more sums.",
        tried: "systems of 1,100 to 6,200 unknowns",
        evidence: "Least degree takes a third fewer sums at 1,700, as many at 1,100 and 3,300, a third more from 5,000.",
    }
    /// Unknowns up to which a piece is not bisected any further.
    DISSECTION_PIECE_MAX: usize = 200, {
        unit: "unknown vertices",
        larger: "Ordering is faster, and pieces have more fill-in.",
        smaller: "Ordering takes longer for nearly the same sums.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest separator: a piece that only a larger one could bisect is ordered by least degree.
    SEPARATOR_PARTS_MIN: usize = 4, {
        unit: "pieces as large as the separator",
        larger: "More pieces are left whole.",
        smaller: "Dense pieces get separators that cost more than they save.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Vertices up to which a graph is bisected without coarsening it first.
    BISECTION_COARSEST: usize = 60, {
        unit: "vertices",
        larger: "The first bisections take longer.",
        smaller: "The first bisections are worse.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Coarsening goes on while it leaves fewer tenths of the vertices than this.
    COARSENING_TENTHS: usize = 9, {
        unit: "tenths of the vertices",
        larger: "Coarsening goes on for little gain.",
        smaller: "Coarsening stops early at vertices with many neighbours.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Places from which a bisection of the coarsest graph is grown.
    BISECTION_STARTS: u32 = 6, {
        unit: "starts",
        larger: "Ordering takes longer, and separators may become smaller.",
        smaller: "Separators may become larger.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Rounds of moves by which a bisection is refined at every size.
    REFINEMENT_ROUNDS: usize = 4, {
        unit: "rounds",
        larger: "Ordering takes longer, and separators may become smaller.",
        smaller: "Separators may become larger.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Moves in a row without gain after which a round of refinement ends.
    REFINEMENT_IDLE_MOVES: usize = 200, {
        unit: "moves",
        larger: "Ordering takes longer, and separators may become smaller.",
        smaller: "Rounds end in local minima.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Vertices above which a graph is coarsened in two ways, of which the better one counts.
    TWO_COARSENINGS_MIN: usize = 1_000, {
        unit: "vertices",
        larger: "Ordering of middle-sized pieces is faster, with larger separators.",
        smaller: "Ordering takes longer.",
        tried: "not recorded",
        evidence: "With two ways 50,000 unknowns of cloth take a tenth fewer sums.",
    }
    /// Vertices up to which neighbouring supernodes count as small when they are merged.
    MERGED_SMALL_VERTICES: usize = 6, {
        unit: "vertices",
        larger: "More zeros are stored in small supernodes.",
        smaller: "More small supernodes are worked on one by one.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of stored zeros up to which small neighbouring supernodes are merged.
    MERGED_SMALL_ZEROS: f64 = 0.8, {
        unit: "share of the entries",
        larger: "More zeros are stored in small supernodes.",
        smaller: "More small supernodes are worked on one by one.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Vertices up to which neighbouring supernodes count as middle-sized when they are merged.
    MERGED_MIDDLE_VERTICES: usize = 16, {
        unit: "vertices",
        larger: "More zeros are stored.",
        smaller: "More supernodes are worked on one by one.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of stored zeros up to which middle-sized neighbouring supernodes are merged.
    MERGED_MIDDLE_ZEROS: f64 = 0.1, {
        unit: "share of the entries",
        larger: "More zeros are stored.",
        smaller: "More supernodes are worked on one by one.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of stored zeros up to which large neighbouring supernodes are merged.
    MERGED_LARGE_ZEROS: f64 = 0.05, {
        unit: "share of the entries",
        larger: "More zeros are stored in large supernodes.",
        smaller: "More supernodes are worked on one by one.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest number of vertices in the columns of a supernode of a large system; wider ones are cut.
    ///
    /// After a cut half of the corner need not be stored, and a panel stays in the processor's cache.
    SUPERNODE_COLUMNS_MAX: u32 = 32, {
        unit: "vertices",
        larger: "More is stored above the diagonal, and panels leave the cache.",
        smaller: "Panels are too narrow for the dense kernels.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest number of vertices in the columns of a supernode of a small system, where cuts save nothing.
    SUPERNODE_COLUMNS_MAX_SMALL: u32 = 128, {
        unit: "vertices",
        larger: "More is stored above the diagonal.",
        smaller: "Small systems have more supernodes.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Unknowns from which a system counts as large: its supernodes are cut, and its factor may have two halves.
    LARGE_SYSTEM_UNKNOWNS: usize = 3_000, {
        unit: "unknown vertices",
        larger: "Middle-sized systems store more and have one thread.",
        smaller: "Small systems pay for cuts and a second thread.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Growth of the factor, as one part in this many, up to which an older order of elimination is kept.
    ///
    /// Couplings may also be fewer by one part in this many.
    ORDER_REUSE_GROWTH_PARTS: usize = 5, {
        unit: "parts of the factor's length",
        larger: "New orders are made more often.",
        smaller: "Older orders are kept with larger factors.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Growth of the number of couplings, as one part in this many, up to which an older order is tried at all.
    ORDER_REUSE_COUPLING_PARTS: usize = 2, {
        unit: "parts of the couplings",
        larger: "New orders are made more often.",
        smaller: "More older orders are tried in vain.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of all work that must be left at most when two threads work on the two halves of a factor.
    HALVES_WORK_MAX: f64 = 0.8, {
        unit: "share of the work",
        larger: "Uneven halves are taken for little gain.",
        smaller: "Systems with a large separator stay with one thread.",
        tried: "not recorded",
        evidence: "No measurement is kept. A closed skirt has halves of 57 and 38 % of the sums.",
    }
    /// Scalars of a factor from which a second thread is worth its start in a solve.
    PARALLEL_SOLVE_SCALARS_MIN: usize = 4_000_000, {
        unit: "scalars",
        larger: "Solves of middle-sized systems take longer.",
        smaller: "Starting a thread costs more than it saves.",
        tried: "not recorded",
        evidence: "No measurement is kept. Starting a thread takes 0.1 ms (docs/lab/2026-11-27-rest-without-time.md).",
    }
    /// Bytes of a factor from which it is put into huge pages; one page has 2 MiB.
    HUGE_PAGE_BYTES_MIN: usize = 8 << 20, {
        unit: "bytes",
        larger: "Middle-sized factors lie in pages of 4 KiB.",
        smaller: "Small factors waste most of a huge page.",
        tried: "not recorded",
        evidence: "40,000 triangles take 15.9 CPU s instead of 17.1, 100,000 39.8 instead of 41.0, 10,000 as much as before.",
    }
}

mechanisms! {
    room "linear";

    /// Orders large systems by nested dissection instead of least degree.
    NESTED_DISSECTION = "nested-dissection";
    /// Keeps an order of elimination while the couplings stay much the same.
    ORDER_REUSE = "order-reuse";
    /// Puts large factors into huge pages.
    HUGE_PAGES = "huge-pages";
    /// Divides a large factor into two halves below its top separator, for two threads.
    SEPARATOR_HALVES = "separator-halves";
}
