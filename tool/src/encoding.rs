//! From the bytes of a part program to text.
//!
//! Only comments and messages hold letters outside of ASCII: a wrong guess at them changes no motion.
//! What is no letter in a comment is refused by the dialect, whatever it was decoded to.

mod guess;
mod pieces;

pub use guess::Words;
pub use pieces::{Piece, Pieces};

use oem_cp::code_table::{DECODING_TABLE_CP850, DECODING_TABLE_CP852};
use std::fmt;

/// How the characters of a file are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Encoding {
    /// UTF-8, which ASCII is a part of, with or without a byte order mark
    #[value(name = "utf-8")]
    Utf8,
    /// Windows, western Europe
    #[value(name = "cp1252")]
    Windows1252,
    /// Windows, central Europe
    #[value(name = "cp1250")]
    Windows1250,
    /// Windows, Cyrillic
    #[value(name = "cp1251")]
    Windows1251,
    /// DOS, western Europe
    #[value(name = "cp850")]
    Dos850,
    /// DOS, central Europe
    #[value(name = "cp852")]
    Dos852,
    /// DOS, Cyrillic
    #[value(name = "cp866")]
    Dos866,
    /// UTF-16, low byte first
    #[value(name = "utf-16le")]
    Utf16Low,
    /// UTF-16, high byte first
    #[value(name = "utf-16be")]
    Utf16High,
}

impl Encoding {
    /// Those with a byte for each character, the likelier ones first.
    pub const SINGLE_BYTE: [Encoding; 6] = [
        Encoding::Windows1252,
        Encoding::Windows1250,
        Encoding::Windows1251,
        Encoding::Dos850,
        Encoding::Dos852,
        Encoding::Dos866,
    ];

    /// The encoding that the first bytes of a file name: a byte order mark.
    pub fn of_mark(bytes: &[u8]) -> Option<Encoding> {
        match bytes {
            [0xFF, 0xFE, ..] => Some(Encoding::Utf16Low),
            [0xFE, 0xFF, ..] => Some(Encoding::Utf16High),
            [0xEF, 0xBB, 0xBF, ..] => Some(Encoding::Utf8),
            _ => None,
        }
    }

    /// The encoding that the beginning of a file shows: by a byte order mark, or because every second byte of it
    /// is 0, as in UTF-16 without one.
    pub fn of_beginning(bytes: &[u8]) -> Option<Encoding> {
        Encoding::of_mark(bytes).or_else(|| {
            let beginning = bytes.get(..bytes.len().min(4096) & !1)?;
            let low = |pair: &&[u8]| matches!(pair, [low, 0] if *low != 0);
            let high = |pair: &&[u8]| matches!(pair, [0, low] if *low != 0);
            let pairs = || beginning.chunks_exact(2);
            let most = pairs().count() * 9 / 10;
            let is = |count: usize| count > most.max(1);
            match (
                is(pairs().filter(low).count()),
                is(pairs().filter(high).count()),
            ) {
                (true, _) => Some(Encoding::Utf16Low),
                (_, true) => Some(Encoding::Utf16High),
                _ => None,
            }
        })
    }

    /// Decodes a file of an encoding with two bytes a character piece by piece.
    pub fn decoder(self) -> encoding_rs::Decoder {
        let standard = self.standard().unwrap_or(encoding_rs::UTF_8);
        standard.new_decoder_with_bom_removal()
    }

    /// The byte order mark that a file may begin with.
    pub fn mark(self) -> &'static [u8] {
        match self {
            Encoding::Utf8 => &[0xEF, 0xBB, 0xBF],
            Encoding::Utf16Low => &[0xFF, 0xFE],
            Encoding::Utf16High => &[0xFE, 0xFF],
            _ => &[],
        }
    }

    /// The text of `bytes`, without a byte order mark at their beginning.
    ///
    /// # Errors
    ///
    /// The position of the first byte that is not UTF-8. All other encodings have a character for
    /// every byte, or a replacement for half of one.
    pub fn decode(self, bytes: &[u8]) -> Result<String, usize> {
        let bytes = bytes.strip_prefix(self.mark()).unwrap_or(bytes);
        if self == Encoding::Utf8 {
            return match std::str::from_utf8(bytes) {
                Ok(text) => Ok(text.to_string()),
                Err(error) => Err(error.valid_up_to()),
            };
        }
        Ok(match self.standard() {
            Some(standard) => standard.decode_without_bom_handling(bytes).0.into_owned(),
            None => bytes.iter().map(|byte| self.character(*byte)).collect(),
        })
    }

    /// The character of a byte; of an encoding that takes several for one, the replacement character.
    pub fn character(self, byte: u8) -> char {
        if byte.is_ascii() {
            return char::from(byte);
        }
        let table = match (self, self.standard()) {
            (Encoding::Dos850, _) => &DECODING_TABLE_CP850,
            (Encoding::Dos852, _) => &DECODING_TABLE_CP852,
            (_, Some(standard)) => {
                let text = standard
                    .decode_without_bom_handling(std::slice::from_ref(&byte))
                    .0;
                return text.chars().next().unwrap_or(char::REPLACEMENT_CHARACTER);
            }
            (_, None) => return char::REPLACEMENT_CHARACTER,
        };
        table[usize::from(byte - 0x80)]
    }

    /// The encodings that browsers know too; CP850 and CP852 are none of them.
    fn standard(self) -> Option<&'static encoding_rs::Encoding> {
        match self {
            Encoding::Utf8 | Encoding::Dos850 | Encoding::Dos852 => None,
            Encoding::Windows1252 => Some(encoding_rs::WINDOWS_1252),
            Encoding::Windows1250 => Some(encoding_rs::WINDOWS_1250),
            Encoding::Windows1251 => Some(encoding_rs::WINDOWS_1251),
            Encoding::Dos866 => Some(encoding_rs::IBM866),
            Encoding::Utf16Low => Some(encoding_rs::UTF_16LE),
            Encoding::Utf16High => Some(encoding_rs::UTF_16BE),
        }
    }
}

impl fmt::Display for Encoding {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Encoding::Utf8 => "UTF-8",
            Encoding::Windows1252 => "CP1252 (Windows, western Europe)",
            Encoding::Windows1250 => "CP1250 (Windows, central Europe)",
            Encoding::Windows1251 => "CP1251 (Windows, Cyrillic)",
            Encoding::Dos850 => "CP850 (DOS, western Europe)",
            Encoding::Dos852 => "CP852 (DOS, central Europe)",
            Encoding::Dos866 => "CP866 (DOS, Cyrillic)",
            Encoding::Utf16Low => "UTF-16, low byte first",
            Encoding::Utf16High => "UTF-16, high byte first",
        })
    }
}

/// The likeliest encoding of `bytes`: what their beginning shows, UTF-8 where they are that, else the
/// encoding with one byte a character that makes the best words of them.
pub fn likeliest(bytes: &[u8]) -> Encoding {
    if let Some(encoding) = Encoding::of_beginning(bytes) {
        return encoding;
    }
    if std::str::from_utf8(bytes).is_ok() {
        return Encoding::Utf8;
    }
    let mut words = Words::default();
    words.collect(bytes);
    words.likeliest()
}

/// The text with all its line ends made `\n`. They may be CR LF, LF, or a lone CR.
pub fn with_plain_line_ends(text: String) -> String {
    match text.contains('\r') {
        true => text.replace("\r\n", "\n").replace('\r', "\n"),
        false => text,
    }
}

/// A file that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decoded {
    /// Its text; all line ends are `\n`.
    pub text: String,
    /// The encoding that was taken, where nobody named it and it is not UTF-8.
    pub guessed: Option<Encoding>,
}

/// The text of a file in the likeliest encoding; all line ends are `\n`. Every sequence of bytes has one.
pub fn decode(bytes: &[u8]) -> String {
    let text = likeliest(bytes).decode(bytes);
    with_plain_line_ends(text.unwrap_or_else(|_| String::from_utf8_lossy(bytes).into_owned()))
}

/// Decodes a part program; without an encoding the likeliest is taken.
///
/// # Errors
///
/// The position of the first byte that does not belong to the encoding.
pub fn decode_as(bytes: &[u8], encoding: Option<Encoding>) -> Result<Decoded, usize> {
    let taken = encoding.unwrap_or_else(|| likeliest(bytes));
    let guessed = encoding.is_none() && taken != Encoding::Utf8;
    Ok(Decoded {
        text: with_plain_line_ends(taken.decode(bytes)?),
        guessed: guessed.then_some(taken),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(bytes: &[u8]) -> String {
        decode(bytes)
    }

    #[test]
    fn utf_8_is_kept_and_its_mark_dropped() {
        assert_eq!(text("ñ ;á".as_bytes()), "ñ ;á");
        assert_eq!(text("\u{feff}G0".as_bytes()), "G0");
        assert_eq!(decode_as("ñ".as_bytes(), None).map(|d| d.guessed), Ok(None));
    }

    #[test]
    fn utf_16_is_told_by_its_mark() {
        assert_eq!(text(b"\xff\xfeG\x000\x00"), "G0");
        assert_eq!(text(b"\xfe\xff\x00G\x000"), "G0");
    }

    #[test]
    fn utf_16_without_a_mark_is_told_by_its_zeros() {
        assert_eq!(text(b"G\x000\x00 \x00X\x001\x00"), "G0 X1");
        assert_eq!(text(b"\x00G\x000\x00 \x00X\x001"), "G0 X1");
        // Fillers of a serial line are no letters.
        assert_eq!(text(b"\0\0\0\0G0 X1\n"), "\0\0\0\0G0 X1\n");
    }

    #[test]
    fn all_line_ends_become_one() {
        assert_eq!(text(b"a\r\nb\rc\nd\r\r\n"), "a\nb\nc\nd\n\n");
    }

    #[test]
    fn an_encoding_that_is_named_holds() {
        let decoded = decode_as(b"; \xa4 \x81", Some(Encoding::Dos850));
        assert_eq!(decoded.map(|d| d.text), Ok("; ñ ü".to_string()));
        assert_eq!(decode_as(b"; \xa4", Some(Encoding::Utf8)), Err(2));
    }
}
