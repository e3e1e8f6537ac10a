# The short front door to CMake. Variables: BUILD (folder), CXX, JOBS, PREFIX, CLANG (for `make
# sanitize`, `make fuzz` and `make tidy`); for `make room`: ROOM (a folder of tests/, e.g. refine or
# io/volume), CASE (a pattern of its test cases); for `make fuzz`: FUZZ_SECONDS (of each target), FUZZ (the
# targets, e.g. "nrrd ply"); for `make tidy`: SINCE (a commit: only files that changed since);
# for `make sanitize`: PROGRAMS (only these, e.g. "tests_refine stress_parts");
# for `make mutants`: ROOM (a folder of tests/, or some); for `make switches`: ONLY (some of them);
# for `make test-all`: TESTS (options of ctest, which choose some);
# for `make course` and `make grade`: COURSE (the folder of the files), EXERCISE (one of them);
# for `make demo`: VOLUME=path ISO=value, OUT (folder the meshes go to); for `make datasets`,
# `make tables`, `make quality`, `make switches`, `make gauntlet` and `make figures`: DATA (folder of volumes); for `make quality`:
# AGAINST (another deliso program, or runs that were kept, .tsv), TURNS, QUALITY (further options); for
# `make gauntlet`: PYTHON (one with NumPy), GAUNTLET (options, e.g. "--count 100 --only PyMCubes"); for
# `make site`: SITE (folder), REPOSITORY (its address, which the page's links lead to), DELISO (a program that is
# built already); for `make web` and `make npm`: WEB (folder of the build).
BUILD ?= build
JOBS  ?= $(shell nproc 2>/dev/null || echo 2)
PREFIX ?= /usr/local
OUT   ?= .
ISO   ?=
TURNS ?= 5
PYTHON ?= python3
SITE  ?= $(BUILD)/site
WEB   ?= build-web
COURSE ?= course
EXERCISE ?=
DATA  ?= $(or $(DELISO_DATA),datasets)

MAKEFLAGS += --no-print-directory
# GNU Make's own default (g++) counts as unset: CMake then looks for a compiler itself.
CXX_FLAG := $(if $(filter default undefined,$(origin CXX)),,-DCMAKE_CXX_COMPILER=$(CXX))
CONFIGURE = cmake -S . -Wno-dev $(CXX_FLAG)
SANITIZE_BUILD = $(BUILD)-sanitize
FUZZ_BUILD = $(BUILD)-fuzz
CLANG ?= clang++
SINCE ?=
ROOM ?=
ROOM_TESTS = tests_$(subst /,_,$(ROOM))
CASE ?=
PROGRAMS ?=
TESTS ?=
TREES = src more deliso check io view app c
OURS = $(shell git ls-files '*.h' '*.cpp' 2>/dev/null || find $(TREES) tests bench figures examples course -name '*.h' -o -name '*.cpp')

.PHONY: all demo test test-all room course grade figures site bench datasets tables quality sanitize fuzz tidy format format-check install
.PHONY: wheel deb doctest clean

all:
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=OFF >/dev/null
	@cmake --build $(BUILD) -j $(JOBS)

# Meshes a built-in field by the exact program and as published, and VOLUME at ISO when given. Of each
# report it shows the mesh, the components found of the true number, and the seconds.
SHOW_MESH = awk '/^mesh/ { mesh = substr($$0, 11); getline; n = true = $$1 } \
  /^found/ { n = $$2; true = $$4 } /^exact  *[0-9]/ { true = $$2 } \
  /^cost/ { printf "%-14s%s\n%-14s%s of %s components, %s seconds\n", name, mesh, "", n, true, $$2 }'
SHOW_RUN = report=$$($(BUILD)/deliso $(1) -o '$(OUT)/$(2)') && echo "$$report" | $(SHOW_MESH) name='$(3)' -
demo: all
	@$(call SHOW_RUN,builtin:fuel --iso 70.1,demo.ply,exact)
	@$(call SHOW_RUN,builtin:fuel --iso 70.1 --paper,demo-paper.ply,as published)
	@$(BUILD)/deliso builtin:fuel --iso 70.1 --cap -q -o - | $(BUILD)/deliso solid - -o '$(OUT)/demo.vtu' | \
	  awk '/^solid/ { print "solid         " substr($$0, 11) } /^angles/ { print "              " substr($$0, 11) }'
ifneq ($(VOLUME),)
	@$(call SHOW_RUN,'$(VOLUME)' $(if $(ISO),--iso $(ISO)),demo-volume.ply,exact)
	@$(call SHOW_RUN,'$(VOLUME)' $(if $(ISO),--iso $(ISO)) --paper,demo-volume-paper.ply,as published)
endif

# The quick tests: each room's, with a tenth of the random cases, and the commands of README.
test: doctest
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=ON -DDELISO_BUILD_BENCH=OFF
	@sh tests/run_tests.sh $(BUILD) $(JOBS) quick_tests -L quick

# All tests, with all cases: also the stress programs, other languages, pages, engines, figures.
test-all: doctest
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=ON -DDELISO_BUILD_BENCH=OFF
	@DELISO_TEST_CASES=all sh tests/run_tests.sh $(BUILD) $(JOBS) all $(TESTS)

# One room and its tests with assertions on, e.g. `make room ROOM=io/volume CASE='*truncated*'`: seconds
# after a change of one file. Its build keeps the other rooms.
room: doctest
	@ls tests/$(ROOM)/test_*.cpp >/dev/null 2>&1 || { echo 'ROOM is a folder of tests/: '$$(cd tests && \
	  ls */test_*.cpp */*/test_*.cpp | sed 's|/[^/]*$$||' | sort -u); exit 2; }
	@started=$$(date +%s); \
	$(CONFIGURE) -B $(BUILD)-room -DCMAKE_BUILD_TYPE=Debug \
	  -DCMAKE_CXX_FLAGS_DEBUG='-O1 -g1 -D_GLIBCXX_ASSERTIONS' -DDELISO_BUILD_TESTS=ON \
	  -DDELISO_BUILD_BENCH=OFF >/dev/null && \
	cmake --build $(BUILD)-room -j $(JOBS) --target $(ROOM_TESTS) && built=$$(date +%s) && \
	{ $(BUILD)-room/tests/$(ROOM_TESTS) $(if $(CASE),--test-case='$(CASE)'); status=$$?; } && \
	echo "compiled in $$((built - started)) s, run in $$(($$(date +%s) - built)) s"; exit $$status

# The exercises of course/, and how many test cases each passes. COURSE is the folder of the files that
# are graded; of one EXERCISE it shows what the compiler and the test say.
CONFIGURE_COURSE = $(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=ON -DDELISO_COURSE='$(abspath $(COURSE))' >/dev/null
course: doctest
	@$(CONFIGURE_COURSE)
	@cmake --build $(BUILD) -j $(JOBS) --target deliso test_main
	@cmake --build $(BUILD) -j $(JOBS) --target course
# All exercises are built first, by all processors; those that do not compile are left to the grader.
grade: doctest
	@$(CONFIGURE_COURSE)
	@cmake --build $(BUILD) -j $(JOBS) --target deliso test_main >/dev/null
	@$(if $(EXERCISE),,if MAKEFLAGS=k cmake --build $(BUILD) -j $(JOBS) --target course >/dev/null 2>&1; then \
	  export DELISO_GRADE_BUILT=1; fi; )sh course/grade.sh $(BUILD) $(EXERCISE)

# docs/figures: the paper's figures, on the volumes in DATA; docs/guide/figures: the guide's, and
# docs/index.html.
figures:
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=ON >/dev/null
	@cmake --build $(BUILD) -j $(JOBS) --target deliso_app list_datasets marching_cubes guide_figures lesson
	@$(BUILD)/figures/guide/guide_figures docs/guide/figures
	@$(BUILD)/deliso info builtin:machine --iso 127.5 -q --size 1140x600 -o docs/guide/figures/slices.png
	@$(BUILD)/figures/lesson/lesson docs/index.html
	@sh figures/draw_figures.sh $(BUILD) docs/figures '$(DATA)'

# The code in docs/, from the sources.
.PHONY: pages
pages:
	@sh tests/docs/code.sh write $$(grep -l '^<!-- code: ' docs/*.md docs/guide/*.md)

# A folder that any static host serves: the page docs/index.html with its drawings, two traces and a view, and
# the program in the browser where `make web` has built it.
site:
ifndef DELISO
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=OFF >/dev/null
	@cmake --build $(BUILD) -j $(JOBS) --target deliso_app
endif
	@WEB='$(WEB)' sh figures/lesson/site.sh '$(SITE)' '$(or $(DELISO),$(BUILD)/deliso)' '$(REPOSITORY)'

# The program as WebAssembly, and its page for a browser, into WEB; the package for npm beside them.
.PHONY: web npm
web:
	@sh web/build.sh '$(WEB)' $(JOBS)
npm: web
	@sh web/pack.sh '$(WEB)'

# The micro-benchmarks, one primitive each; they need no data.
bench:
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=ON >/dev/null
	@cmake --build $(BUILD) -j $(JOBS)
	@for source in bench/bench_*.cpp; do \
	  name=$$(basename $$source .cpp); started=$$(date +%s); \
	  printf '\n== %s\n' $$name; sed -n '2,/^[^\/]/s|^// \{0,1\}||p' $$source; echo; \
	  $(BUILD)/bench/$$name || exit 1; \
	  echo "($$name took $$(($$(date +%s) - started)) s)"; \
	done

# The volumes that are public as plain files, into the folder DATA.
datasets:
	@sh bench/fetch_datasets.sh bench/datasets.tsv '$(DATA)'

# docs/results.md and its plots: the paper's tables and the studies, on the volumes in DATA.
tables:
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=ON >/dev/null
	@cmake --build $(BUILD) -j $(JOBS)
	@sh bench/write_results.sh $(BUILD) docs '$(DATA)'

# What the meshes of the volumes in DATA and of built-in fields are worth, beside AGAINST: medians and
# ranges over TURNS. All runs go to BUILD/quality.tsv, which a later AGAINST may name when copied.
quality:
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=ON >/dev/null
	@cmake --build $(BUILD) -j $(JOBS) --target deliso_app quality
	@$(BUILD)/bench/quality --program $(BUILD)/deliso $(if $(AGAINST),--against '$(AGAINST)') \
	  --data '$(DATA)' --turns $(TURNS) --runs $(BUILD)/quality.tsv --markdown $(QUALITY)

# The meshers that are installed (bench/gauntlet/tools.py), on 1,000 random small volumes and on crops of
# the volumes in DATA, scored by `deliso check`, and by CGAL where it is there. Into BUILD/gauntlet go the scores, and the smallest failure of each kind.
.PHONY: gauntlet
gauntlet:
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=ON >/dev/null
	@cmake --build $(BUILD) -j $(JOBS) --target deliso_app gauntlet
	@$(PYTHON) -B bench/gauntlet/gauntlet.py $(BUILD) $(BUILD)/gauntlet --jobs $(JOBS) \
	  $(if $(wildcard $(DATA)/.),--data '$(DATA)') $(GAUNTLET)

# docs/guide/options.md, from the program's own table.
.PHONY: options
options:
	@$(CONFIGURE) -B $(BUILD) >/dev/null
	@cmake --build $(BUILD) -j $(JOBS) --target deliso_app
	@$(BUILD)/deliso help markdown >docs/guide/options.md

# The table of docs/switches.md: what the meshes of five volumes are worth without each mechanism that
# a record there defends, or with another constant; all, or those named in ONLY. Minutes for each.
# Without the volumes in DATA built-in fields stand in, and the rows of volumes go from the table.
.PHONY: switches
switches:
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=ON >/dev/null
	@cmake --build $(BUILD) -j $(JOBS) --target quality
	@CXX='$(CXX)' JOBS=$(JOBS) sh bench/switches/run.sh $(BUILD) docs/switches.md '$(DATA)' $(ONLY)

# Whether the tests of a primitive find a wrong one: each patch of bench/mutants in turn, in a copy of
# the sources, against the tests of its room. Lists those that survive.
.PHONY: mutants
mutants: doctest
	@$(CONFIGURE) -B $(BUILD) -DDELISO_BUILD_TESTS=ON >/dev/null
	@cmake --build $(BUILD) -j $(JOBS) --target deliso
	@CXX='$(CXX)' sh bench/mutants/run.sh $(BUILD) $(JOBS) $(ROOM)

# The lines that no quick test reaches; of src, more, deliso and check.
COVERAGE_BUILD = $(BUILD)-coverage
.PHONY: coverage
coverage: doctest
	@$(CONFIGURE) -B $(COVERAGE_BUILD) -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS='--coverage -O1 -fno-inline' \
	  -DCMAKE_CXX_FLAGS_DEBUG= -DDELISO_BUILD_TESTS=ON -DDELISO_BUILD_BENCH=OFF >/dev/null
	@cmake --build $(COVERAGE_BUILD) -j $(JOBS) --target quick_tests
	@find $(COVERAGE_BUILD) -name '*.gcda' -delete
	@ctest --test-dir $(COVERAGE_BUILD) -j $(JOBS) -L quick -R '^test_' | tail -n 4
	@sh tests/coverage.sh . $(COVERAGE_BUILD)

# The tests of code under AddressSanitizer and UndefinedBehaviorSanitizer, with assertions on: by
# clang where there is one, since it compiles them in half the time.
sanitize: doctest
	@cmake -S . -Wno-dev -B $(SANITIZE_BUILD) -DDELISO_SANITIZE=ON -DDELISO_BUILD_BENCH=OFF \
	  $(if $(shell command -v $(CLANG)),-DCMAKE_CXX_COMPILER=$(CLANG),$(CXX_FLAG))
	@cmake --build $(SANITIZE_BUILD) -j $(JOBS) --target $(or $(PROGRAMS),all)
	@ctest --test-dir $(SANITIZE_BUILD) --output-on-failure -j $(JOBS) \
	  $(if $(PROGRAMS),-L '^($(shell echo $(PROGRAMS) | tr ' ' '|'))$$')

# Every libFuzzer target (tests/fuzz) for FUZZ_SECONDS (60), or those in FUZZ; the corpus is kept.
fuzz:
	@cmake -S . -Wno-dev -B $(FUZZ_BUILD) -DCMAKE_CXX_COMPILER=$(CLANG) -DDELISO_BUILD_FUZZERS=ON \
	  -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=OFF >/dev/null
	@cmake --build $(FUZZ_BUILD) -j $(JOBS)
	@sh tests/fuzz/run.sh $(FUZZ_BUILD)/tests/fuzz $(FUZZ_BUILD)/corpus $(FUZZ)

# A changed header stands for the file of its name, or for itself if there is none. Files are looked at
# one by one, so each must include what it needs. Headers are known by their folders in this clone, wherever it
# lies: a folder above it may be called check.
HERE = $(shell printf %s '$(CURDIR)' | sed 's/[][\\.*^$$()+?{}|]/\\&/g')
TIDY = clang-tidy --quiet -p $(BUILD)-tidy --header-filter='^$(HERE)/($(subst $() ,|,$(TREES)))/.*\.h$$'
tidy:
	@cmake -S . -Wno-dev -B $(BUILD)-tidy -DCMAKE_CXX_COMPILER=$(CLANG) -DDELISO_UNITE=OFF \
	  -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=OFF >/dev/null
	@$(if $(SINCE),git diff --name-only $(SINCE) -- $(TREES),find $(TREES) -name '*.cpp' -o -name '*.h') | \
	  grep '\.\(cpp\|h\)$$' | while read -r file; do \
	    source=$${file%.h}.cpp; [ -f "$$source" ] || source=$$file; [ ! -f "$$source" ] || echo "$$source"; \
	  done | sort -u | \
	  xargs -r -P $(JOBS) -n 1 $(TIDY)

format:
	clang-format -i $(OURS)
format-check:
	clang-format --dry-run --Werror $(OURS)

install: all
	cmake --install $(BUILD) --prefix $(PREFIX)

# The Python package with its library, for this platform, into BUILD.
wheel: all
	@cd python && python3 -c 'import deliso_wheel, sys; print(deliso_wheel.build_wheel(sys.argv[1], \
	  {"library": sys.argv[2]}))' '$(abspath $(BUILD))' '$(abspath $(BUILD))/libdeliso_c.so'

# What `make install` lays down, under /usr, as a package of Debian into BUILD. Debian's Python looks
# for packages in a folder of its own; ours finds the library beside its files, by a link.
DEB = $(BUILD)/deb
deb: all
	@rm -rf $(DEB) && mkdir -p $(DEB)/DEBIAN $(DEB)/usr/lib/python3/dist-packages
	@DESTDIR='$(abspath $(DEB))' cmake --install $(BUILD) --prefix /usr --strip >/dev/null
	@cd $(DEB)/usr/lib && mv "$$(find . -path '*/python/deliso')" python3/dist-packages/ \
	  && find . -type d -name python -empty -delete \
	  && ln -s "../../../$$(find . -name 'libdeliso_c.so' -printf '%P')" python3/dist-packages/deliso/
	@printf '%s\n' 'Package: deliso' "Version: $$($(BUILD)/deliso --version | cut -d' ' -f2)" \
	  "Architecture: $$(dpkg --print-architecture)" 'Section: science' 'Priority: optional' \
	  'Maintainer: DelIso' 'Depends: libc6, libstdc++6' 'Recommends: python3-numpy' \
	  'Description: Delaunay meshes of isosurfaces of volume data' >$(DEB)/DEBIAN/control
	@dpkg-deb --root-owner-group --build $(DEB) $(BUILD)

# The tests' one dependency. CMake fetches the upstream release where this finds no way.
doctest:
	@if ! echo '#include <doctest/doctest.h>' | $(CXX) -E -x c++ - >/dev/null 2>&1 \
	    && [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	  echo 'installing doctest-dev'; \
	  apt-get install -y -qq --no-install-recommends doctest-dev >/dev/null 2>&1 || \
	    { apt-get update -qq && \
	      apt-get install -y -qq --no-install-recommends doctest-dev >/dev/null; } || \
	    echo 'doctest-dev could not be installed'; \
	fi

clean:
	rm -rf $(BUILD) $(COVERAGE_BUILD) $(SANITIZE_BUILD) $(FUZZ_BUILD) $(BUILD)-tidy $(BUILD)-room $(WEB)
