# framepath. The two commands for a newcomer: make demo, make test. All others: make help.

# make takes a blank for the end of a name, also one in front of it or behind it: rm would have two. The shell, and sed, take
# some characters for other than a part of a name.
PATHS = CURDIR CARGO_TARGET_DIR DESTDIR PREFIX LINUXCNC_SOURCE
open := (
close := )
SPECIAL = & \ | ; < > * ? [ ] ' " ` $$ $(open) $(close)
$(foreach name,$(PATHS),$(if $(word 2,x$($(name))x),$(error \
    $(name)=$($(name)) has a blank, at which make cuts it: take a path without one)))
$(foreach name,$(PATHS),$(foreach character,$(SPECIAL),$(if $(findstring $(character),$($(name))),$(error \
    $(name)=$($(name)) has $(character), which the shell does not take for a part of a name: take a path without it))))

CARGO ?= cargo
PYTHON = /usr/bin/python3
TARGET := $(abspath $(or $(CARGO_TARGET_DIR),target))
$(if $(filter $(CURDIR),$(realpath $(TARGET))),$(error \
    CARGO_TARGET_DIR=$(CARGO_TARGET_DIR) is the folder of the source: take one in it or beside it))
# cargo builds there and nowhere else, whatever its own configuration ([build] target-dir) says: what was built earlier would
# be taken otherwise. So does every make that this one starts, in other folders, too.
override export CARGO_TARGET_DIR := $(TARGET)
MAKEOVERRIDES := $(filter-out CARGO_TARGET_DIR=%,$(MAKEOVERRIDES))
MODULES = $(TARGET)/modules
FAULT_MODULES = $(TARGET)/fault-modules
# dev builds faster: the tests use it
TOOL_PROFILE ?= release
TOOL = $(TARGET)/$(if $(filter dev,$(TOOL_PROFILE)),debug,$(TOOL_PROFILE))/framepath

DESTDIR ?=
PREFIX ?= /usr
# The samples name what they need with it, wherever they are copied to.
$(if $(filter /%,$(PREFIX)),,$(error PREFIX=$(PREFIX) does not begin with /: take the whole path, $(abspath $(or $(PREFIX),/usr))))
MODULE_FOLDER = $(DESTDIR)/usr/lib/linuxcnc/modules
SHARE = $(DESTDIR)$(PREFIX)/share/framepath
MAN = $(DESTDIR)$(PREFIX)/share/man
BIN = $(DESTDIR)$(PREFIX)/bin
# Where Debian's bash, zsh and fish look. zsh knows another folder of /usr/local than of /usr.
ZSH_FUNCTIONS = zsh/$(if $(filter /usr,$(PREFIX:%/=%)),vendor-completions,site-functions)
COMPLETIONS = $(addprefix $(DESTDIR)$(PREFIX)/share/,bash-completion/completions/framepath \
    $(ZSH_FUNCTIONS)/_framepath fish/vendor_completions.d/framepath.fish)
# Where LinuxCNC's selector of configurations looks for those of other packages.
EXAMPLES = $(DESTDIR)/usr/share/linuxcnc/aux_examples

# A source tree of LinuxCNC, built or not, for headers that the packages lack: those of 2.10 have none of motion and its
# planner. The headers are looked for in their folders, the version is in a file.
ifneq ($(LINUXCNC_SOURCE),)
HEADER_FOLDERS = rtapi hal emc emc/ini emc/kinematics emc/motion emc/nml_intf emc/rs274ngc emc/tp libposemath $(addprefix \
    libnml/,buffer cms inifile linklist nml os_intf posemath rcs)
empty :=
export LINUXCNC_INCLUDE := $(subst $(empty) ,:,$(wildcard $(addprefix $(abspath $(LINUXCNC_SOURCE))/src/,$(HEADER_FOLDERS))))
export LINUXCNC_VERSION := $(shell cat $(LINUXCNC_SOURCE)/VERSION 2> /dev/null)
# Where it was built, the command runs the interpreter and the planner from there.
ifneq ($(wildcard $(LINUXCNC_SOURCE)/lib/librs274.so),)
export LINUXCNC_IN_PLACE := $(abspath $(LINUXCNC_SOURCE))
endif
ifeq ($(LINUXCNC_INCLUDE),)
$(error LINUXCNC_SOURCE=$(LINUXCNC_SOURCE) has no src/emc/motion: it is to be the folder of LinuxCNC's source)
endif
ifeq ($(LINUXCNC_VERSION),)
$(error LINUXCNC_SOURCE=$(LINUXCNC_SOURCE) has no version in a file VERSION: it is to be the folder of LinuxCNC's source)
endif
endif

export FRAMEPATH_MODULES = $(MODULES)
export FRAMEPATH_FAULT_MODULES = $(FAULT_MODULES)
export FRAMEPATH_TOOL = $(TOOL)

help:
	@echo 'make demo       install what is missing, build, run the main job in a headless LinuxCNC, show a report'
	@echo 'make test       install what is missing, build, run the tests: a quarter of an hour on two processors'
	@echo 'make thorough   the tests that make test leaves out since they take long: as much again'
	@echo 'make lint       the style of the Rust, and what clippy and mypy find'
	@echo 'make linuxcnc-test  only those of the tests that run a real LinuxCNC'
	@echo 'make modules    build framekins.so and blendtp.so into $(MODULES)'
	@echo '                LINUXCNC_SOURCE=/path/to/linuxcnc: with the headers of this source of LinuxCNC, whose packages may lack them'
	@echo 'make tool       build the framepath command'
	@echo 'make install    put modules, command, subroutines, samples, man pages and completions where they belong (DESTDIR, PREFIX)'
	@echo 'make uninstall  remove them again'
	@echo 'make deb        a Debian package for this machine; make deb-source: one that is built where it is installed'
	@echo 'make debian-12  make test in a Debian 12 of its own; make debian-13: in a Debian 13'
	@echo 'make sanitize   only the tests with the address and undefined-behaviour sanitizers and valgrind'
	@echo 'make contract   only promises of LinuxCNC with its own planner and with blendtp, soak, plan against LinuxCNC'
	@echo 'make faults     what LinuxCNC does with both modules when something goes wrong, as the table of docs/faults.md'
	@echo 'make machines   LinuxCNC'"'"'s sample machines (tables, heads, robots, deltas) with both modules, as the table of docs/machines.md'
	@echo 'make suites LINUXCNC_SOURCE=/path/to/linuxcnc  LinuxCNC'"'"'s own suites with its own planner and with blendtp, as the table of'
	@echo '                docs/suites.md: of the LinuxCNC that was built there, or of the installed one (SUITES="motion abort/g64": only these)'
	@echo 'make short      thousands of random short programs through framepath plan: faults and limits that are exceeded'
	@echo 'make soak       long runs: 10,000 random programs with random operators, where more of anything costs time, two hours in a real LinuxCNC'
	@echo 'make fuzz       any calls of the C interface of both modules, ten minutes each (FUZZ_SECONDS); make fuzz-filter: of the filter'
	@echo 'make mutants    faults drawn at random, put into the core: how many the Rust tests catch (MUTANTS=120, SEED=); an hour'
	@echo 'make deny       licences, known faults and sources of the crates that are used (cargo-deny)'
	@echo 'make ruff       the style of the Python'
	@echo 'make bench      measure the functions that the servo thread calls'
	@echo 'make compare    drive LinuxCNC'"'"'s own planner and blendtp with the same programs and tabulate what they do'
	@echo 'make figures    more about blendtp: least costs of its calls, a restless operator, feed holds, queues, distance from the least time'
	@echo 'make five-axes  both planners on a table with the tool centre point: peaks of its joints, and the distance from the least time'
	@echo 'make tuning     what each constant that tunes the planner does to the times of programs: docs/tuning.md'
	@echo 'make book       docs, DESIGN and CONTRIBUTING as a book (mdbook)'
	@echo 'make screens    each sample in AXIS, two with their panels in gmoccapy, one in qtdragon, without a monitor: pictures in target/screens'
	@echo 'make header     write include/framepath.h anew from the Rust side of the interface'

prerequisites:
	@./prerequisites

# What root has built (sudo make install) no other user can build on: said before cargo or the compiler stumble over it.
BUILT_IN = $(MODULES) $(FAULT_MODULES) $(COMPLETED) $(addprefix $(TARGET)/,realtime release debug)

buildable:
	@foreign=$$([ -w $(TARGET) ] || [ ! -e $(TARGET) ] || echo $(TARGET); \
	    for folder in $(wildcard $(BUILT_IN)); do find -H $$folder -maxdepth 2 ! -type l ! -writable -print -quit; done); \
	[ -z "$$foreign" ] || { set -- $$foreign; echo "make: $$(id -un) may not write $$1, which belongs to $$(stat -c %U $$1):" \
	    "sudo chown -R $$(id -un) $(TARGET), or make CARGO_TARGET_DIR=... with a folder of yours" >&2; exit 1; }

modules: buildable prerequisites
	$(MAKE) -C hal-component OUT=$(MODULES) built-for
	$(CARGO) build --locked --profile realtime --lib
	$(MAKE) -C hal-component LIBRARY=$(TARGET)/realtime/libframepath.a OUT=$(MODULES)

# The modules with pins that make the planner fail in a servo period of one's choice: only for tests.
fault-modules: modules
	$(CARGO) build --locked --profile realtime --lib --features fault-injection
	$(MAKE) -C hal-component LIBRARY=$(TARGET)/realtime/libframepath.a OUT=$(FAULT_MODULES) \
	    DEFINES=-DFRAMEPATH_FAULT_INJECTION

tool: buildable prerequisites
	$(CARGO) build --locked --profile $(TOOL_PROFILE) -p framepath-tool

demo: modules tool
	./demo/run

# What the filter and the report are built with where there is no LinuxCNC: no headers, no libclang.
WITHOUT_LINUXCNC = LINUXCNC_INCLUDE=/nonexistent LIBCLANG_PATH=/nonexistent

lint:
	@./prerequisites lint
	$(CARGO) fmt --all --check
	$(CARGO) clippy --locked --workspace --all-targets -- -D warnings
	$(WITHOUT_LINUXCNC) $(CARGO) clippy --locked -p framepath-tool --no-default-features --all-targets -- -D warnings
	$(PYTHON) -m mypy
	! $(CARGO) tree --locked -p framepath-tool --no-default-features --edges normal,build | grep -E 'bindgen|clang|clarabel'

# The style of the Python, pyproject.toml. Wants ruff, which Debian 12 does not have: pip install ruff.
ruff:
	ruff check .

# Licences, known faults and sources of all dependencies: deny.toml. Wants the network and cargo-deny:
# cargo install cargo-deny --locked.
deny:
	$(CARGO) deny check licenses advisories bans sources

# Many at a time, each in a LinuxCNC of its own that mostly waits; fewer of what is busy by itself, when all the others are done.
LINUXCNC_TESTS = $(PYTHON) -B -m pytest tests/linuxcnc
# $(call run_linuxcnc_tests,and ...): only those with such marks (tests/linuxcnc/pytest.ini).
run_linuxcnc_tests = failed=0; $(LINUXCNC_TESTS) -n 12 -m "not busy $(1)" || failed=1; \
    $(LINUXCNC_TESTS) -n 6 -m "busy $(1)" || failed=1; exit $$failed

# The same random cases each time, so that what fails can be had again; make soak takes others.
test thorough: export PROPTEST_RNG_SEED ?= 1
# A text that differs from its snapshot, or has none, fails and writes nothing.
test thorough: export INSTA_UPDATE = no
test thorough: export TOOL_PROFILE = dev
# Planners are tested on the stack (with_room in tests/planner/common): one that has been used before costs no time.
test thorough: export RUST_MIN_STACK = 268435456

# The tests of cargo and, for them, the tool in their profile.
cargo-tests: buildable prerequisites
	$(CARGO) test --locked --workspace --no-run

# Two profiles of cargo: neither waits for the other, and what links on one processor leaves the other to what compiles.
BUILD_WHAT_IS_TESTED = $(MAKE) --jobs=2 --output-sync=target fault-modules cargo-tests

# A quarter of an hour on two processors.
test:
	@./prerequisites browser screen sanitize package test
	$(BUILD_WHAT_IS_TESTED)
	$(CARGO) test --locked --workspace --no-fail-fast
	$(call run_linuxcnc_tests,and not thorough)

# The rest, which takes longer: more random programs, every screen, packages, all examples of the manuals, soak.
thorough:
	@./prerequisites browser screen sanitize package test
	$(BUILD_WHAT_IS_TESTED)
	FRAMEPATH_CASES=10000 $(CARGO) test --locked --workspace --test planner short_programs::
	$(CARGO) test --locked --workspace --no-fail-fast -- --ignored
	$(call run_linuxcnc_tests,and thorough)

# What runs in a real LinuxCNC, with the modules and the tool as they are built.
linuxcnc-test: modules fault-modules tool
	@./prerequisites screen test
	$(call run_linuxcnc_tests)

# The C of the modules with sanitizers, the modules under valgrind; a part of make test.
sanitize: modules
	@./prerequisites sanitize
	$(PYTHON) -B tests/linuxcnc/test_sanitizers.py -v

# What comes last in make test and make thorough: the table of promises, two minutes of soak, plan against LinuxCNC.
contract: modules tool
	@./prerequisites test
	$(LINUXCNC_TESTS) -m busy

# Processes killed and stopped, aborts, an INI file without sense, servo periods, full disks: half an hour; then a fault of
# the planner in each servo period of a program: another half.
faults: modules fault-modules tool
	$(PYTHON) -B tests/linuxcnc/faults/fault_table.py
	FRAMEPATH_FAULT_EVERY=1 $(PYTHON) -B tests/linuxcnc/test_faults_injected.py

# LinuxCNC's own sample configurations by themselves, behind framekins and with blendtp: ten minutes.
machines: modules
	@./prerequisites test
	$(PYTHON) -B tests/linuxcnc/machines.py

# LinuxCNC's own suites, which its packages lack: a quarter of an hour.
SUITES ?=

suites: $(if $(LINUXCNC_SOURCE),modules,no-source)
	@./prerequisites suites
	$(PYTHON) -B tests/linuxcnc/suites.py $(LINUXCNC_SOURCE) $(SUITES)

no-source:
	@echo "make suites LINUXCNC_SOURCE=/path/to/linuxcnc: LinuxCNC's packages have no suites, its source has" >&2; exit 1

SHORT ?= 5000
SEED ?= 1
short: tool
	$(PYTHON) -B tests/linuxcnc/short_programs.py --count $(SHORT) --seed $(SEED)

soak: modules
	FRAMEPATH_CASES=10000 $(CARGO) test --locked --release --test planner programs:: -- --skip short_programs:: --nocapture
	FRAMEPATH_CASES=1000000 $(CARGO) test --locked --release --test planner short_programs:: -- --nocapture
	FRAMEPATH_CASES=10000 $(CARGO) test --locked --release --test planner monotone:: -- --nocapture
	FRAMEPATH_CASES=2000 $(CARGO) test --locked --release --test planner dense_passes:: -- --nocapture
	$(PYTHON) -B tests/linuxcnc/soak.py --seconds 7200

bench: prerequisites
	$(CARGO) bench --locked --workspace
	FRAMEPATH_PAGE_MOVES=1000000 $(CARGO) test --locked --release -p framepath-tool --test page_speed -- --nocapture
	$(PYTHON) -B benches/table.py $(TARGET)/criterion

# libFuzzer (the crate brings it) without cargo-fuzz: these flags are all that it needs of the compiler, and a stable one
# takes them. What it finds lies in artifacts; the program with that file as its argument runs it again, with
# -minimize_crash=1 makes it smaller.
FUZZ_SECONDS ?= 600
FUZZ_HOST = $(shell rustc -vV | sed -n 's/^host: //p')
FUZZ_FLAGS = -Cpasses=sancov-module --cfg fuzzing \
    $(addprefix -Cllvm-args=-sanitizer-coverage-,level=4 inline-8bit-counters pc-table trace-compares)
FUZZ_BUILD = CARGO_TARGET_DIR=target RUSTFLAGS="$(FUZZ_FLAGS)" $(CARGO) build --locked --target $(FUZZ_HOST)

# The C interface of both modules, any calls with any values: ten minutes each.
fuzz: prerequisites
	cd fuzz && $(FUZZ_BUILD) --release
	for target in frames planner; do \
	    mkdir -p fuzz/corpus/$$target fuzz/artifacts/$$target && \
	    fuzz/target/$(FUZZ_HOST)/release/$$target -max_total_time=$(FUZZ_SECONDS) -timeout=60 -max_len=2000 -len_control=0 \
	        -artifact_prefix=fuzz/artifacts/$$target/ fuzz/corpus/$$target || exit 1; \
	done

# The same for the filter: any bytes as a program.
DIALECT ?= sinumerik

fuzz-filter:
	cd tool/fuzz && CARGO_PROFILE_DEV_OPT_LEVEL=1 $(FUZZ_BUILD)
	mkdir -p tool/fuzz/corpus/$(DIALECT)
	DIALECT=$(DIALECT) tool/fuzz/target/$(FUZZ_HOST)/debug/dialect -max_total_time=$(FUZZ_SECONDS) -timeout=20 tool/fuzz/corpus/$(DIALECT)

# Mutation testing, see tests/mutants, which has what is known to change nothing. Wants cargo-mutants, which knows the mutants:
# cargo install cargo-mutants --locked. Cut short, it goes on with RESUME=1 and the same seed.
MUTANTS ?= 120
RESUME ?=

mutants: prerequisites
	$(PYTHON) -B tests/mutants/mutants.py --count $(MUTANTS) $(if $(filter-out file,$(origin SEED)),--seed $(SEED)) $(if $(RESUME),--resume)

# LinuxCNC's sample programs as they are, where the feed limits most of them, then with every F raised, and the
# generated programs.
NCFILES ?= /usr/share/linuxcnc/ncfiles
COMPARED = $(patsubst %,$(NCFILES)/%.ngc,3D_Chips tort arcspiral daisy cds flowsnake spiral mmount)
COMPARED_JERK = --jerk unlimited,100A,20A

RAISED = $(COMPARED) --generated all --feed-at-least 6000

compare: modules tool
	$(TOOL) compare $(COMPARED) $(COMPARED_JERK)
	$(TOOL) compare $(RAISED) $(COMPARED_JERK)

# The same with a restless operator, with feed holds, with the queue kept short, and against the least time that the
# limits allow on the path that was run, which takes long to find.
BLENDTP = --with $(MODULES)/blendtp.so

# Programs that a host with a short queue hands over.
SHORT_QUEUE = $(patsubst %,$(NCFILES)/%.ngc,tort arcspiral) --feed-at-least 6000 \
    $(addprefix --generated ,dense trochoidal squares-p.5 arcs)

# Lines with two feeds, or two path modes, in turn.
ALTERNATING = --generated alternating-feeds --generated alternating-modes

figures: modules tool
	$(TOOL) compare $(RAISED) $(COMPARED_JERK) --repeat 5
	$(TOOL) compare $(RAISED) $(BLENDTP) $(COMPARED_JERK) --operator 1 --velocity-limit 200
	$(TOOL) compare $(RAISED) $(BLENDTP) $(COMPARED_JERK) --holds 50
	$(TOOL) compare --generated trochoidal $(BLENDTP) --jerk 20A --queue 200,2000
	$(TOOL) compare $(SHORT_QUEUE) --jerk unlimited,20A --queue 2,5,10
	$(TOOL) compare $(ALTERNATING) $(COMPARED_JERK) --optimum
	$(TOOL) compare $(RAISED) $(BLENDTP) --jerk 20A,100A --optimum

# A tilting table with the tool centre point: LinuxCNC's five-axis programs, without the M428 and M429 that switch it there, a
# generated one and ten random ones; then with a restless operator. What a servo period costs with exact jets and with those by numbers:
# the same machine behind LinuxCNC's kinematics of such a table, the least of some runs.
TABLE_PROGRAMS ?= /usr/share/doc/linuxcnc/examples/sample-configs/sim/axis/vismach/5axis/table-rotary-tilting/demos
TABLE_SAMPLE = hal-component/configs/framepath-xyzac/framepath-xyzac
TABLE_FEED = --feed-at-least 6000 --jerk 20A
TABLE = --ini $(TABLE_SAMPLE).ini --tool-centre-point $(TABLE_FEED)
TABLE_KINEMATICS = xyzac-trt-kins
BY_NUMBERS = --ini $(TARGET)/five-axes/by-numbers.ini $(TABLE_FEED)
RANDOM_SEEDS = 1 2 3 4 5 6 7 8 9 10
FIVE_AXES = $(patsubst %,$(TARGET)/five-axes/%.ngc,boat-xyzac impeller-7bl-xyzac $(addprefix random-,$(RANDOM_SEEDS))) --generated blade

five-axes: modules tool
	@mkdir -p $(TARGET)/five-axes
	for program in boat impeller-7bl; do \
	    (echo 'G64 P0.05' && sed 's/^%.*//; s/^M42[89].*//' $(TABLE_PROGRAMS)/$$program-xyzac.ngc) \
	    > $(TARGET)/five-axes/$$program-xyzac.ngc || exit 1; done
	for seed in $(RANDOM_SEEDS); do \
	    $(TOOL) generate random-five-axes --seed $$seed \
	    > $(TARGET)/five-axes/random-$$seed.ngc || exit 1; done
	$(TOOL) compare $(FIVE_AXES) $(TABLE) --optimum
	$(TOOL) compare $(FIVE_AXES) $(TABLE) --operator 1
	sed 's/^KINEMATICS = .*/KINEMATICS = $(TABLE_KINEMATICS) coordinates=XYZAC/; s/^HALFILE = framepath-xyzac/HALFILE = by-numbers/' \
	    $(TABLE_SAMPLE).ini > $(TARGET)/five-axes/by-numbers.ini
	sed 's/^loadrt \[KINS\]/loadrt framekins inner=$(TABLE_KINEMATICS)\n&/; s/framekins\.\(.-rot-point\|.-offset\|tool-offset\)\( \|$$\)/$(TABLE_KINEMATICS).\1\2/' \
	    $(TABLE_SAMPLE).hal > $(TARGET)/five-axes/by-numbers.hal
	$(PYTHON) -B benches/five_axes_cost.py --exact '$(TABLE)' --by-numbers '$(BY_NUMBERS)' $(TOOL) $(BLENDTP) $(FIVE_AXES)

# What each constant that tunes does, written into docs/tuning.md: an hour.
tuning: modules tool
	$(PYTHON) -B benches/tuning.py --tool $(TOOL) --target $(TARGET)

# docs, DESIGN and CONTRIBUTING as pages to read: target/book/index.html.
book:
	mdbook build

# Pictures of each sample in AXIS, of two in gmoccapy and one in qtdragon, and of two simulated machines of LinuxCNC in a frame, on an
# X server without a monitor: target/screens.
screens: modules
	@./prerequisites screen
	$(PYTHON) -B tests/linuxcnc/screens.py $(TARGET)/screens

header:
	FRAMEPATH_WRITE_HEADER=1 $(CARGO) test --locked --test header

# Made with the build, so that root only copies what another user has built, and runs nothing of it.
COMPLETED = $(TARGET)/completions

completions: tool
	mkdir -p $(COMPLETED)
	for shell in bash zsh fish; do \
	    new=$(COMPLETED)/$$shell.$$$$; \
	    $(TOOL) completions $$shell > $$new && mv $$new $(COMPLETED)/$$shell || { rm -f $$new; exit 1; }; \
	done

# Said before the minutes of a build. A folder that is not there yet is made in the next one above it.
installable:
	@for folder in $(MODULE_FOLDER) $(EXAMPLES) $(BIN) $(SHARE) $(MAN); do \
	    there=$$folder; until [ -e $$there ]; do there=$$(dirname $$there); done; \
	    [ -w $$there ] || { echo "make install: $$(id -un) may not write $$folder: sudo make install," \
	        "or make install DESTDIR=... with a folder of yours" >&2; exit 1; }; \
	done

# What dpkg has put there it has to remove. framepath-source makes this install and uninstall from its own source, what is
# installed then is in no list of dpkg.
PACKAGED = $(addprefix $(MODULE_FOLDER)/,framekins.so blendtp.so) $(abspath $(BIN))/framepath \
    $(if $(filter $(realpath /usr/src/framepath),$(CURDIR)),,/usr/lib/framepath/build-where-installed)

no-package:
	@[ -n "$(DESTDIR)" ] || { \
	    owner=$$(dpkg-query -S $(PACKAGED) 2> /dev/null | sed -n '/^diversion /d; s/: .*//p' | head -n 1); \
	    [ -z "$$owner" ] || { echo "make: what is installed belongs to the Debian package $$owner, and nothing was changed:" \
	        "sudo apt remove $$owner; then make again" >&2; exit 1; }; }

# What goes into $(SHARE): not what a run of a sample in the source has left there.
SHARED_PROGRAMS = subroutines/frame_guard.py panel/program_time.py
SHARED_PATTERNS = subroutines/*.ngc subroutines/frame_*.py subroutines/README.md preview/*.py panel/time_table.py \
    $(addprefix panel/*.,xml ui hal) $(addprefix configs/*/*.,hal ini ngc tbl)
SHARED_TEXTS = $(filter-out $(SHARED_PROGRAMS),$(patsubst hal-component/%,%,$(wildcard $(addprefix hal-component/,$(SHARED_PATTERNS)))))
# They name others by where they are in the source; a copy in the user's folder has to find them, too.
WITH_PATHS = $(filter configs/%.ini configs/%.hal panel/%.xml panel/%.hal,$(SHARED_TEXTS))

# What was put into $(SHARE) is listed there: users put files of theirs beside it, into folders of ours, too.
INSTALLED = installed-files
REMOVE_INSTALLED = if [ -e $(SHARE)/$(INSTALLED) ]; then cd $(SHARE) && xargs -r -d '\n' rm -f -- < $(INSTALLED); fi
REMOVE_EMPTY = if [ -d $(SHARE) ]; then \
    rm -rf $(addprefix $(SHARE)/,$(addsuffix /__pycache__,subroutines preview panel)) && find $(SHARE) -depth -type d -empty -delete; fi

comma := ,

# The usual prefix that this one is not: what is installed there comes first in PATH, or is left behind. The modules have one
# folder for both.
OTHER_PREFIX = $(if $(filter /usr/local,$(PREFIX:%/=%)),/usr,/usr/local)
TELL_OTHER = if [ -e $(DESTDIR)$(OTHER_PREFIX)/bin/framepath ]; then \
    echo "make $@: another one is there, $(DESTDIR)$(OTHER_PREFIX)/bin/framepath: to remove it make uninstall PREFIX=$(OTHER_PREFIX)$(1)"; fi

install: no-package installable modules completions
# What an older one had and this one has not goes, since LinuxCNC would find it. What users have put beside it stays. One that
# left no list may have left either.
	@if [ -d $(SHARE) ] && [ ! -e $(SHARE)/$(INSTALLED) ]; then \
	    if others=$$(cd $(SHARE) && find . -type f -printf '%P\n' | grep -Fvx $(addprefix -e ,$(SHARED_TEXTS) $(SHARED_PROGRAMS))); then \
	        printf '%s\n' "make install: left in $(SHARE), since they are yours or of a framepath that kept no list:" "$$others"; fi; fi
	@{ \
	    for module in framekins blendtp; do \
	        echo 644 $(MODULES)/$$module.so $(MODULE_FOLDER)/$$module.so; \
	        echo 644 hal-component/$$module.9 $(MAN)/man9/$$module.9; \
	    done; \
	    echo 755 $(TOOL) $(BIN)/framepath; \
	    echo 644 tool/framepath.1 $(MAN)/man1/framepath.1; \
	    for file in $(filter-out $(WITH_PATHS),$(SHARED_TEXTS)); do echo 644 hal-component/$$file $(SHARE)/$$file; done; \
	    for file in $(WITH_PATHS); do echo sample hal-component/$$file $(SHARE)/$$file; done; \
	    for file in $(SHARED_PROGRAMS); do echo 755 hal-component/$$file $(SHARE)/$$file; done; \
	    echo link $(PREFIX)/share/framepath/configs $(EXAMPLES)/framepath; \
	    echo 644 $(COMPLETED)/bash $(word 1,$(COMPLETIONS)); \
	    echo 644 $(COMPLETED)/zsh $(word 2,$(COMPLETIONS)); \
	    echo 644 $(COMPLETED)/fish $(word 3,$(COMPLETIONS)); \
	} | ./put-in-place $(SHARE) $(PREFIX)/share/framepath
	@$(REMOVE_EMPTY)
	@echo "make install: in place are $(MODULE_FOLDER)/framekins.so and blendtp.so, $(BIN)/framepath, $(SHARE)"
	@$(call TELL_OTHER,$(comma) then make install again)

uninstall: no-package
	rm -f $(MODULE_FOLDER)/framekins.so $(MODULE_FOLDER)/blendtp.so $(BIN)/framepath
	rm -f $(MAN)/man9/framekins.9 $(MAN)/man9/blendtp.9 $(MAN)/man1/framepath.1
	rm -f $(COMPLETIONS)
	@$(REMOVE_INSTALLED)
# An older one has left no list: what this one has goes.
	@rm -f $(addprefix $(SHARE)/,$(SHARED_TEXTS) $(SHARED_PROGRAMS))
	@$(REMOVE_EMPTY)
	rm -f $(EXAMPLES)/framepath
	@if [ -d $(SHARE) ]; then echo "make uninstall: left, since framepath has not put them there:" && find $(SHARE) ! -type d; fi
	@$(TELL_OTHER)

# Packages are made from a copy of the source beside what is built: target/package. What is built may lie in the source under
# any name, which tar would copy into itself; and runs of the samples leave files in their folders.
PACKAGE = $(TARGET)/package
BUILT_INSIDE = $(addprefix ./,$(filter-out ../%,$(shell realpath -m --relative-to=. $(TARGET) $(PACKAGE))))
LEFT_OUT = target __pycache__ ./.git *.var *.var.bak position.txt $(BUILT_INSIDE)
COPY_SOURCE = version=$$(debian/package-version) && rm -rf $(PACKAGE)/framepath $(PACKAGE)/$(1)_* && mkdir -p $(PACKAGE)/framepath && \
    tar -c --exclude-caches-all $(addprefix --exclude=,$(LEFT_OUT)) . | tar -x -C $(PACKAGE)/framepath && \
    sed -i "1s/(.*)/($$version)/" $(PACKAGE)/framepath/debian/changelog
BUILD_PACKAGE = cd $(PACKAGE)/framepath && CARGO_TARGET_DIR=$(TARGET) FRAMEPATH_BUILT=1 dpkg-buildpackage -d -nc -us -uc

# With the modules for the LinuxCNC that is installed: sudo apt install ./target/package/framepath_*.deb
deb: modules tool
	@./prerequisites package
	$(call COPY_SOURCE,framepath)
	$(BUILD_PACKAGE) -B

# With the source alone, which may be given away: built where it is installed, and again when LinuxCNC is upgraded.
deb-source:
	@./prerequisites package
	$(call COPY_SOURCE,framepath-source)
	$(BUILD_PACKAGE) -A

# COMMAND='make linuxcnc-test' runs that instead. As root.
debian-12 debian-13:
	tests/debian/run $(subst debian-,,$@) $(COMMAND)

clean:
	$(CARGO) clean

.PHONY: help prerequisites buildable modules fault-modules tool demo lint ruff deny test cargo-tests thorough linuxcnc-test sanitize contract faults machines suites no-source short soak bench \
    fuzz fuzz-filter mutants compare figures five-axes tuning book screens header completions installable no-package install uninstall deb deb-source \
    debian-12 debian-13 clean
