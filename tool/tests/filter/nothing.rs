//! Files with nothing in them: LinuxCNC would refuse a program without an end, and pass over a subprogram.

use crate::shop::{Shop, accepted, refused};

#[test]
fn a_program_without_a_block_is_refused() {
    for dialect in ["sinumerik", "fagor", "mefi", "isg", "fanuc"] {
        for content in ["", "\n\n"] {
            let shop = Shop::new(&[("part.nc", content.as_bytes())]);
            for backend in ["auto", "kinematics", "program"] {
                let error = refused(&shop.run_in(dialect, "part.nc", &["--backend", backend]));
                assert!(
                    error.contains("there is no block in this program"),
                    "{dialect}: {error}"
                );
            }
        }
    }
    let shop = Shop::new(&[("part.nc", b"O1\n".as_slice())]);
    refused(&shop.run_in("fanuc", "part.nc", &[]));
    let shop = Shop::new(&[("part.nc", b"M30\n".as_slice())]);
    let output = accepted(&shop.run_in("fanuc", "part.nc", &[]));
    assert!(output.contains("\nM30 "), "{output}");
}

#[test]
fn a_subprogram_file_without_a_block_is_refused() {
    for (dialect, call, file) in [
        ("fanuc", "M98 P11", "O0011.nc"),
        ("sinumerik", "EMPTY", "EMPTY.SPF"),
        ("isg", "L EMPTY.NC", "EMPTY.NC"),
    ] {
        let program = format!("G90 G0 X0 Y0\n{call}\nM30\n");
        let error = |content: &str| {
            let files = [("part.nc", program.as_bytes()), (file, content.as_bytes())];
            refused(&Shop::new(&files).run_in(dialect, "part.nc", &[]))
        };
        for content in ["", "\n \n"] {
            let error = error(content);
            let words = "there is no block in this subprogram";
            assert!(
                error.contains(words) && error.contains(file),
                "{dialect}: {error}"
            );
        }
    }
}
