//! From the bytes of a part program to text.

use encoding_rs::{UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

/// Decodes a part program and makes all its line ends `\n`.
///
/// UTF-8 with or without a byte order mark, UTF-16 with one, and Windows-1252 for all that is not
/// valid UTF-8: that is what controls and CAM systems of the last thirty years have written.
/// Line ends may be CR LF, LF, or a lone CR. Every sequence of bytes decodes to some text.
pub fn decode(bytes: &[u8]) -> String {
    let text = if bytes.starts_with(&[0xFF, 0xFE]) {
        UTF_16LE.decode(bytes).0
    } else if bytes.starts_with(&[0xFE, 0xFF]) {
        UTF_16BE.decode(bytes).0
    } else if let Some(text) = UTF_8.decode_without_bom_handling_and_without_replacement(
        bytes.strip_prefix(&[0xEF, 0xBB, 0xBF]).unwrap_or(bytes),
    ) {
        text
    } else {
        WINDOWS_1252.decode(bytes).0
    };
    text.replace("\r\n", "\n").replace('\r', "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf_8_is_kept_and_its_mark_dropped() {
        assert_eq!(decode("ñ ;á".as_bytes()), "ñ ;á");
        assert_eq!(decode("\u{feff}G0".as_bytes()), "G0");
    }

    #[test]
    fn what_is_not_utf_8_is_windows_1252() {
        assert_eq!(decode(b"; \xd1and\xfa \x80"), "; Ñandú €");
    }

    #[test]
    fn utf_16_is_told_by_its_mark() {
        assert_eq!(decode(b"\xff\xfeG\x000\x00"), "G0");
        assert_eq!(decode(b"\xfe\xff\x00G\x000"), "G0");
    }

    #[test]
    fn all_line_ends_become_one() {
        assert_eq!(decode(b"a\r\nb\rc\nd\r\r\n"), "a\nb\nc\nd\n\n");
    }
}
