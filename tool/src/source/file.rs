//! One file of the sources. Of a long one only some pages are held; the others are read again when they are
//! needed.

use super::page::Page;
use crate::encoding::Pieces;
use std::cell::RefCell;
use std::io;
use std::rc::Rc;

/// How many pages of a long file are held at once: that of the block that runs, those of the ends of a loop.
const HELD: usize = 4;

/// One decoded file; its line ends are all `\n`.
#[derive(Debug)]
pub struct SourceFile {
    /// What messages call it, usually its path.
    pub name: String,
    windowed: bool,
    pages: RefCell<Pages>,
}

/// Where a page begins.
#[derive(Clone, Copy, Debug, Default)]
struct Beginning {
    /// In the file as it is on the disk, bytes.
    place: u64,
    /// In the decoded text, bytes.
    position: usize,
    /// Index of its first line.
    line: usize,
}

#[derive(Debug)]
struct Pages {
    /// Of the pages that were read so far, and of the one behind them.
    beginnings: Vec<Beginning>,
    /// Pages with their indices, the last that was asked for first.
    held: Vec<(usize, Rc<Page>)>,
    /// Where pages come from; `None` where the only one is held.
    pieces: Option<Pieces>,
}

impl SourceFile {
    /// A file whose text is held.
    pub(super) fn whole(name: String, text: String) -> SourceFile {
        let page = Page::new(text, 0, 0);
        let behind = Beginning {
            place: 1,
            position: page.end() + 1,
            line: page.first_line() + page.line_ends() + 1,
        };
        SourceFile {
            name,
            windowed: false,
            pages: RefCell::new(Pages {
                beginnings: vec![Beginning::default(), behind],
                held: vec![(0, Rc::new(page))],
                pieces: None,
            }),
        }
    }

    /// A file of which some pages are held.
    pub(super) fn windowed(name: String, pieces: Pieces) -> SourceFile {
        SourceFile {
            name,
            windowed: true,
            pages: RefCell::new(Pages {
                beginnings: vec![Beginning::default()],
                held: Vec::new(),
                pieces: Some(pieces),
            }),
        }
    }

    /// Whether only some pages of the file are held.
    pub fn is_windowed(&self) -> bool {
        self.windowed
    }

    /// How many line ends the file has, as far as it has been read.
    pub fn lines(&self) -> usize {
        let pages = self.pages.borrow();
        match (&pages.pieces, pages.held.first()) {
            (None, Some((_, page))) => page.line_ends(),
            _ => pages.beginnings.last().map_or(0, |last| last.line),
        }
    }

    /// The page with this index; `None` behind the end of the file.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read.
    pub fn page(&self, index: usize) -> io::Result<Option<Rc<Page>>> {
        self.pages.borrow_mut().page(index)
    }

    /// The page with this line; `None` behind the last line.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read.
    pub fn page_of_line(&self, line: usize) -> io::Result<Option<Rc<Page>>> {
        let has = |page: &Page| {
            let first = page.first_line();
            (first..first + page.line_ends().max(1)).contains(&line)
        };
        self.page_where(has, |beginning| beginning.line <= line)
    }

    /// The page with this position; the last one also has the end of the file.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read.
    pub fn page_at(&self, position: usize) -> io::Result<Option<Rc<Page>>> {
        let has = |page: &Page| (page.start()..page.end()).contains(&position);
        self.page_where(has, |beginning| beginning.position <= position)
    }

    /// The text of the first page; empty where it cannot be read.
    pub fn beginning(&self) -> String {
        let first = self.page(0).ok().flatten();
        first.map_or(String::new(), |page| page.text().to_string())
    }

    /// The page that `has` what is looked for, or the last one that begins before it.
    fn page_where(
        &self,
        has: impl Fn(&Page) -> bool,
        begins_before: impl Fn(&Beginning) -> bool,
    ) -> io::Result<Option<Rc<Page>>> {
        let mut pages = self.pages.borrow_mut();
        if let Some((_, page)) = pages.held.first()
            && has(page)
        {
            return Ok(Some(Rc::clone(page)));
        }
        let before = pages.beginnings.partition_point(begins_before);
        let index = before.saturating_sub(1);
        match pages.page(index)? {
            Some(page) => Ok(Some(page)),
            // The end of the file belongs to its last page.
            None => match index.checked_sub(1) {
                Some(last) => pages.page(last),
                None => Ok(None),
            },
        }
    }
}

impl Pages {
    fn page(&mut self, index: usize) -> io::Result<Option<Rc<Page>>> {
        if let Some(at) = self.held.iter().position(|(held, _)| *held == index) {
            self.held[..=at].rotate_right(1);
            return Ok(self.held.first().map(|(_, page)| Rc::clone(page)));
        }
        let (Some(pieces), Some(beginning)) = (&mut self.pieces, self.beginnings.get(index)) else {
            return Ok(None);
        };
        let Some(piece) = pieces.text_at(beginning.place)? else {
            return Ok(None);
        };
        let page = Rc::new(Page::new(piece.lines, beginning.position, beginning.line));
        if index + 1 == self.beginnings.len() {
            self.beginnings.push(Beginning {
                place: piece.next,
                position: page.end(),
                line: page.first_line() + page.line_ends(),
            });
        }
        self.held.truncate(HELD - 1);
        self.held.insert(0, (index, Rc::clone(&page)));
        Ok(Some(page))
    }
}
