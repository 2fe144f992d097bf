//! Which encoding makes words of the bytes outside of ASCII.

use super::Encoding;

/// How many words are looked at.
const MOST_WORDS: usize = 2000;

/// Letters of the languages that an encoding was made for; those of other languages count less.
const WESTERN: &str = "äöüßÄÖÜñÑáéíóúÁÉÍÓÚçÇàèìòùâêîôûëïÀÈÉÊåøæÅØÆãõ";
const CENTRAL: &str = "ěščřžýáíéůúňťďĚŠČŘŽÝÁÍÉŮÚŇŤĎąćęłńóśźżĄĆĘŁŃÓŚŹŻőűŐŰăâîșțşţľĺŕôäöüÄÖÜßđĐ";

/// The words with bytes outside of ASCII in a file whose encoding nobody named.
#[derive(Clone, Debug, Default)]
pub struct Words {
    words: Vec<Vec<u8>>,
}

impl Words {
    /// Looks for further words, each once; those at the two ends of `bytes` must be whole.
    pub fn collect(&mut self, bytes: &[u8]) {
        if self.words.len() >= MOST_WORDS || bytes.is_ascii() {
            return;
        }
        let is_word = |byte: &u8| !byte.is_ascii() || byte.is_ascii_alphabetic();
        for word in bytes.split(|byte| !is_word(byte)) {
            if self.words.len() >= MOST_WORDS {
                break;
            }
            if !word.is_ascii() && !self.words.iter().any(|known| known == word) {
                self.words.push(word.to_vec());
            }
        }
    }

    /// The encoding that makes the best words; of equals, the likelier one.
    pub fn likeliest(&self) -> Encoding {
        let score = |encoding: &Encoding| -> i64 {
            let scores = self.words.iter().map(|word| score(*encoding, word));
            scores.sum()
        };
        let mut best = (Encoding::Windows1252, i64::MIN);
        for encoding in Encoding::SINGLE_BYTE {
            let its_score = score(&encoding);
            if its_score > best.1 {
                best = (encoding, its_score);
            }
        }
        best.0
    }
}

/// How well a word reads: letters of the languages of the encoding, of one script, no capitals behind
/// small letters; marks only at its ends.
fn score(encoding: Encoding, word: &[u8]) -> i64 {
    let text: Vec<char> = word.iter().map(|byte| encoding.character(*byte)).collect();
    let usual = match encoding {
        Encoding::Windows1252 | Encoding::Dos850 => WESTERN,
        _ => CENTRAL,
    };
    let cyrillic = matches!(encoding, Encoding::Windows1251 | Encoding::Dos866);
    let mut score = 0;
    for (at, character) in text.iter().copied().enumerate() {
        let before = at.checked_sub(1).and_then(|at| text.get(at)).copied();
        let after = text.get(at + 1).copied();
        let neighbours = [before, after];
        if let (Some(before), true) = (before, character.is_uppercase())
            && before.is_lowercase()
        {
            score -= 3;
        }
        if character.is_ascii() {
            continue;
        }
        score += if !character.is_alphabetic() {
            mark(character, neighbours)
        } else if cyrillic {
            match character {
                'А'..='я' | 'Ё' | 'ё' => letter_of_script(neighbours),
                _ => -3,
            }
        } else if usual.contains(character) {
            // Latin words have few such letters beside each other.
            match neighbours
                .iter()
                .flatten()
                .filter(|c| !c.is_ascii())
                .count()
            {
                0 => 4,
                1 => 1,
                _ => -4,
            }
        } else {
            -1
        };
    }
    score
}

/// A letter of another script beside ASCII letters belongs to no word.
fn letter_of_script(neighbours: [Option<char>; 2]) -> i64 {
    let mut beside = neighbours.iter().flatten();
    match (neighbours, beside.any(char::is_ascii_alphabetic)) {
        (_, true) => -3,
        // Every byte is a letter here: one alone says nothing.
        ([None, None], _) => 0,
        _ => 4,
    }
}

/// Quotation marks, signs of degrees and the like stand at the ends of words; lines of tables and
/// controls nowhere.
fn mark(character: char, neighbours: [Option<char>; 2]) -> i64 {
    let inside = neighbours
        .iter()
        .flatten()
        .filter(|c| c.is_alphabetic())
        .count()
        == 2;
    match character {
        '°' | '±' | '“' | '”' | '„' | '‘' | '’' | '–' | '—' | '…' | '«' | '»' | '²' | '³' | 'µ'
        | '×' | '½' | '¼' | '§' | '€' | '¿' | '¡' | '№' | '®' | '\u{a0}'
            if !inside =>
        {
            1
        }
        c if c.is_control() => -8,
        _ => -5,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(encoding: Encoding, text: &str) -> Vec<u8> {
        let byte = |wanted: char| (0..=255).find(|byte| encoding.character(*byte) == wanted);
        text.chars().map(|c| byte(c).unwrap_or(b'?')).collect()
    }

    #[test]
    fn programs_of_many_countries_are_read() {
        for (encoding, text) in [
            (Encoding::Windows1252, "; Fräser für Öffnung, Maß 5°"),
            (
                Encoding::Windows1252,
                "; Mecanización de la pieza: año, señal",
            ),
            (Encoding::Windows1252, "; ébauche, finition à l'intérieur"),
            (Encoding::Dos850, "; Fräser für Öffnung"),
            (Encoding::Dos850, "; MECANIZACIÓN pieza del año, señal más"),
            (Encoding::Windows1251, "; Вызов подпрограммы, фреза 10"),
            (
                Encoding::Windows1251,
                "; ОТРАЖЕНИЕ (переводит направление X)",
            ),
            (Encoding::Dos866, "; Вызов подпрограммы"),
            (Encoding::Windows1250, "; Střed díry, načisto, výška"),
            (Encoding::Dos852, "; Střed díry, načisto, výška hřídele"),
            (Encoding::Windows1250, "; Wiercenie otworów, głębokość"),
        ] {
            let mut words = Words::default();
            words.collect(&bytes(encoding, text));
            assert_eq!(words.likeliest(), encoding, "{text}");
        }
    }
}
