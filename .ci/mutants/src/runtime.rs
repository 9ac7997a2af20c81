//! Which mutant is on: a module of the rewritten tree. The environment chooses, `MUTANT` one, and
//! `MUTANTS_REACHED` a file to which is appended which places the process reaches.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};

/// From here on a number means none.
const NONE: u32 = 1 << 30;
const RECORDING: u32 = u32::MAX - 1;
const UNREAD: u32 = u32::MAX;

static CHOSEN: AtomicU32 = AtomicU32::new(UNREAD);
static REACHED: [AtomicBool; 1 << 16] = [const { AtomicBool::new(false) }; 1 << 16];
static FILE: LazyLock<Option<File>> = LazyLock::new(|| {
    let path = std::env::var_os("MUTANTS_REACHED")?;
    OpenOptions::new().append(true).create(true).open(path).ok()
});

/// Returns which mutant is on of the place whose mutants count from `first`: 0 for the first, or a
/// number beyond the last.
#[inline]
pub fn at(first: u32) -> u32 {
    let chosen = CHOSEN.load(Relaxed);
    if chosen >= RECORDING { beside(first) } else { chosen.wrapping_sub(first) }
}

#[cold]
#[inline(never)]
fn beside(first: u32) -> u32 {
    // Most calls end here: a read costs a fraction of an exchange.
    if REACHED[first as usize].load(Relaxed) {
        return NONE;
    }
    if CHOSEN.load(Relaxed) == UNREAD {
        let one = std::env::var("MUTANT").ok().and_then(|number| number.parse().ok());
        let none = if FILE.is_some() { RECORDING } else { NONE };
        CHOSEN.store(one.unwrap_or(none), Relaxed);
    }
    let chosen = CHOSEN.load(Relaxed);
    if chosen != RECORDING {
        return chosen.wrapping_sub(first);
    }
    if !REACHED[first as usize].swap(true, Relaxed)
        && let Some(mut file) = FILE.as_ref()
    {
        let _ = file.write_all(format!("{first}\n").as_bytes());
    }
    NONE
}

/// An iterator of a type without a name, or the items that a mutant has in its place.
#[derive(Clone)]
pub enum Items<I: Iterator> {
    Original(I),
    Mutant(std::vec::IntoIter<I::Item>),
}

impl<I: Iterator> Iterator for Items<I> {
    type Item = I::Item;

    fn next(&mut self) -> Option<I::Item> {
        match self {
            Items::Original(items) => items.next(),
            Items::Mutant(items) => items.next(),
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        match self {
            Items::Original(items) => items.size_hint(),
            Items::Mutant(items) => items.size_hint(),
        }
    }
}

impl<I: DoubleEndedIterator> DoubleEndedIterator for Items<I> {
    fn next_back(&mut self) -> Option<I::Item> {
        match self {
            Items::Original(items) => items.next_back(),
            Items::Mutant(items) => items.next_back(),
        }
    }
}

impl<I: ExactSizeIterator> ExactSizeIterator for Items<I> {}
