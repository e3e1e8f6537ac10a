// SPDX-License-Identifier: MIT
#include "app/output.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/check.h"
#include "io/files/temporary_folder.h"
#include "refusal.h"

using namespace deliso;
using namespace deliso::test;

namespace {

using Names = std::vector<std::string>;

// The fault of a run of these files; empty when there is none.
std::string fault(const Names& outputs, const Names& inputs) {
  return refusal_by([&] { require_outputs(outputs, inputs); });
}

}  // namespace

TEST_CASE("an output that cannot be written is refused before the work") {
  CHECK(fault({"-", "", "/dev/null"}, {}) == "");
  CHECK(fault({"mesh-of-the-test.ply"}, {}) == "");
  CHECK_FALSE(std::filesystem::exists("mesh-of-the-test.ply"));
  CHECK(fault({"/no/such/folder/mesh.ply"}, {}) ==
        "cannot write '/no/such/folder/mesh.ply': No such file or directory");
  CHECK(fault({"/"}, {}) == "cannot write '/': Is a directory");
  CHECK(fault({"."}, {}) == "cannot write '.': Is a directory");
  const std::string long_name(300, 'x');
  CHECK(fault({long_name}, {}).ends_with("File name too long"));
  if (geteuid() != 0) {  // root may write everything
    const TemporaryFolder folder;
    write_bytes(folder / "a.ply", "old");
    std::filesystem::permissions(folder / "a.ply", std::filesystem::perms::owner_read);
    CHECK(fault({folder / "a.ply"}, {}).ends_with("Permission denied"));
  }
}

TEST_CASE("an output that is the same file as another name is refused") {
  const TemporaryFolder folder;
  const std::string a = folder / "a", same = folder / "./a", hard = folder / "hard",
                    soft = folder / "soft", b = folder / "b", absent = folder / "absent",
                    dangling = folder / "dangling";
  write_bytes(a, "a");
  write_bytes(b, "b");
  std::filesystem::create_hard_link(a, hard);
  std::filesystem::create_symlink("a", soft);
  std::filesystem::create_symlink("absent", dangling);

  for (const std::string& name : {a, same, hard, soft}) {
    CAPTURE(name);
    CHECK(fault({name}, {a}) ==
          "cannot write '" + name + "': this run reads that file as '" + a + "'");
    CHECK(fault({b, name}, {"builtin:sphere", hard}) != "");
    CHECK(fault({a, name}, {b}) ==
          "cannot write '" + name + "': this run writes that file as '" + a + "'");
    CHECK(fault({name}, {b, "builtin:a", "nowhere"}) == "");
  }
  CHECK(fault({absent, dangling}, {}) != "");
  CHECK(fault({dangling, absent}, {a}) != "");
  CHECK(fault({absent, b}, {a, dangling}) != "");
  CHECK(fault({absent, b}, {a}) == "");
  CHECK(fault({"/dev/null", "/dev/null"}, {"/dev/null"}) == "");
  for (const std::string& name : {a, b}) CHECK(std::filesystem::file_size(name) == 1);
}
