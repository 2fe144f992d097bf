//! Tests of `framepath filter` for programs of Fanuc-like controls.

mod cycles;
mod errors;
mod frames;
#[path = "../filter/front_end.rs"]
mod front_end;
mod haas;
mod language;
mod lathe;
mod moves;
#[path = "../filter/one_error.rs"]
mod one_error;
mod path;
mod polar;
mod random;
mod robustness;
#[path = "../filter/rs274.rs"]
mod rs274;
mod shifts;
#[path = "../filter_isg_mefi/shop.rs"]
mod shop;
