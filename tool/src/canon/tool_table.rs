//! LinuxCNC's tool table: a line for each tool, words of a letter and a number, comments from `;`.

use super::call::Position;
use std::path::{Path, PathBuf};

/// A tool, in machine units and degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tool {
    /// T.
    pub number: i32,
    /// P.
    pub pocket: i32,
    /// X Y Z A B C U V W.
    pub offset: Position,
    /// D.
    pub diameter: f64,
    /// I, degrees.
    pub front_angle: f64,
    /// J, degrees.
    pub back_angle: f64,
    /// Q.
    pub orientation: i32,
}

/// Why a tool table cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ToolTableError {
    /// The file cannot be opened.
    #[error("{}: the tool table cannot be read: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A line is not understood.
    #[error(
        "{}:{line}: `{word}` is no word of a tool table: T, P, D, I, J, Q or the letter of an axis, \
         and a number",
        file.display()
    )]
    Word {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What was found.
        word: String,
    },
}

/// Reads a tool table.
///
/// # Errors
/// A file that cannot be read, a word that is not understood.
pub fn read_tool_table(file: &Path) -> Result<Vec<Tool>, ToolTableError> {
    let bytes = std::fs::read(file).map_err(|source| ToolTableError::Read {
        file: file.to_owned(),
        source,
    })?;
    let mut tools = Vec::new();
    for (index, line) in String::from_utf8_lossy(&bytes).lines().enumerate() {
        let mut tool = Tool::default();
        let mut words = line.split(';').next().unwrap_or("").split_whitespace();
        let unknown = words.find(|word| take(&mut tool, word).is_none());
        if let Some(word) = unknown {
            return Err(ToolTableError::Word {
                file: file.to_owned(),
                line: index + 1,
                word: word.to_owned(),
            });
        }
        if tool.number > 0 {
            tools.push(tool);
        }
    }
    Ok(tools)
}

fn take(tool: &mut Tool, word: &str) -> Option<()> {
    let mut characters = word.chars();
    let letter = characters.next()?.to_ascii_uppercase();
    let number = characters.as_str();
    let whole = || number.parse::<i32>().ok();
    let real = || number.parse::<f64>().ok().filter(|n| n.is_finite());
    match letter {
        'T' => tool.number = whole()?,
        'P' => tool.pocket = whole()?,
        'Q' => tool.orientation = real()? as i32,
        'D' => tool.diameter = real()?,
        'I' => tool.front_angle = real()?,
        'J' => tool.back_angle = real()?,
        _ => {
            let axis = "XYZABCUVW".find(letter)?;
            tool.offset[axis] = real()?;
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_comments() {
        let mut tool = Tool::default();
        for word in ["T3", "P7", "z+12.5", "D6", "Q2", "W-1"] {
            assert!(take(&mut tool, word).is_some(), "{word}");
        }
        assert_eq!((tool.number, tool.pocket, tool.orientation), (3, 7, 2));
        assert_eq!((tool.offset[2], tool.offset[8]), (12.5, -1.0));
        for word in ["T", "K1", "Zx", "Znan"] {
            assert!(take(&mut tool, word).is_none(), "{word}");
        }
    }
}
