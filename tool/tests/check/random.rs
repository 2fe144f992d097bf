//! Any bytes, and samples with lines changed at random: no panic, and nothing that does not end.

use crate::bench::samples;
use framepath_tool::check::{Level, look_at_text};
use proptest::prelude::*;
use std::path::Path;

fn accept(_: &[String]) -> Result<(), String> {
    Ok(())
}

/// How many findings these files give; looks at each place.
fn look(ini: &[u8], hal: &[u8]) -> usize {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("m.hal"), hal).expect("written");
    let file = folder.path().join("m.ini");
    let report = look_at_text(&file, &String::from_utf8_lossy(ini), &accept);
    let errors = report
        .findings
        .iter()
        .filter(|finding| finding.level == Level::Error);
    assert_eq!(errors.count(), report.errors);
    for finding in &report.findings {
        assert!(!finding.found.is_empty() && Path::new(&finding.file).file_name().is_some());
    }
    report.findings.len()
}

/// The text of a sample with HALFILE = m.hal, and that of its HAL file.
fn sample(name: &str) -> (String, String) {
    let folder = samples().join("configs").join(name);
    let read = |ending: &str| {
        std::fs::read_to_string(folder.join(format!("{name}.{ending}"))).expect("a text")
    };
    (
        read("ini").replace(&format!("HALFILE = {name}.hal"), "HALFILE = m.hal"),
        read("hal"),
    )
}

/// A word that means something in one of the files.
fn piece() -> impl Strategy<Value = String> {
    let known = prop::sample::select(vec![
        "[AXIS_X]",
        "[",
        "]",
        "(",
        ")",
        "$",
        "$(",
        "=",
        "=>",
        "#",
        "\\\n",
        "\n",
        "\"",
        "'",
        "net",
        "setp",
        "addf",
        "loadrt",
        "loadusr -Wn",
        "source m.hal",
        "framekins",
        "blendtp.axis.x.max-jerk",
        "motmod num_aio=",
        "REMAP = ",
        "1e999",
        "-1",
        "NaN",
        "coordinates=",
        "[KINS]KINEMATICS",
        "[FRAMEPATH]\n",
        "HALFILE = m.hal\n",
        "#INCLUDE m.ini\n",
        "#INCLUDE $(id)\n",
        "alias pin a",
        "unlinkp",
        "delsig",
        "linkpp",
        "servo-thread -9223372036854775808",
        "ä",
        "\u{0}",
    ]);
    prop_oneof![known.prop_map(str::to_owned), "[ -~]{0,8}"]
}

/// The text with a piece in place of a stretch of it.
fn with_piece(text: &str, place: prop::sample::Index, length: usize, piece: &str) -> String {
    let characters: Vec<char> = text.chars().collect();
    let start = place.index(characters.len());
    let end = (start + length).min(characters.len());
    let [before, behind] =
        [&characters[..start], &characters[end..]].map(|part| part.iter().collect::<String>());
    before + piece + &behind
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes(ini in prop::collection::vec(any::<u8>(), 0..400), hal in prop::collection::vec(any::<u8>(), 0..400)) {
        let with_hal = [b"[EMC]\nVERSION = 1.1\n[HAL]\nHALFILE = m.hal\n[TRAJ]\nTPMOD = blendtp\n[KINS]\nKINEMATICS = framekins\n", ini.as_slice()].concat();
        look(&ini, &hal);
        prop_assert!(look(&with_hal, &hal) > 0);
    }

    #[test]
    fn any_words(ini in prop::collection::vec(piece(), 0..30), hal in prop::collection::vec(piece(), 0..30)) {
        let ini = format!("[EMC]\nVERSION = 1.1\n[HAL]\nHALFILE = m.hal\n{}", ini.join(" "));
        look(ini.as_bytes(), hal.join(" ").as_bytes());
    }

    #[test]
    fn samples_with_something_else_in_them(
        tilted in any::<bool>(),
        in_hal in any::<bool>(),
        place in any::<prop::sample::Index>(),
        length in 0usize..40,
        piece in piece(),
    ) {
        let (ini, hal) = sample(if tilted { "framepath-xyzac" } else { "framepath-sim" });
        let (ini, hal) = match in_hal {
            true => (ini, with_piece(&hal, place, length, &piece)),
            false => (with_piece(&ini, place, length, &piece), hal),
        };
        look(ini.as_bytes(), hal.as_bytes());
    }
}
