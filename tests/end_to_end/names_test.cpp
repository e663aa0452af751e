// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Names in Latin-1, with control characters and formulas go through every command.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/base/names.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

bool is_utf8(const std::string& text) { return utf8_text(text) == text; }

std::string all_replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// The square with names as German programs of the nineties wrote them, and worse; its study names
/// the material in UTF-8.
struct Strange : SquareFolder {
  Strange() {
    std::string obj = all_replaced(square_obj, "usemtl plaster",
                                   "usemtl Au\xDF"
                                   "enputz");
    obj = all_replaced(obj, "o house", "o Geb\xE4ude");
    obj = all_replaced(obj, "o awning", "o =HYPERLINK(\"x\")");
    obj = all_replaced(obj, "o lamp", "o \x1B[31mlamp");
    folder.write("square.obj", obj);
    write_study(all_replaced(square_study(), "    plaster:", "    Außenputz:"));
    const Ran ran = run("results");
    EXPECT_EQ(ran.code, 0) << ran.err;
    err = ran.err;
  }
  std::string err;
};

const Strange& strange() {
  static const Strange once;
  return once;
}

TEST(StrangeNames, AreNotedAndKnownToTheStudy) {
  const Ran ran = program(strange().folder, {"check", "square.yaml"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("2 names not in UTF-8, read as Windows-1252 (Latin-1): 'Gebäude', …"),
            std::string::npos)
      << ran.out;
  EXPECT_NE(ran.out.find("1 name with control characters, which are written out: '\\x1b[31mlamp'"),
            std::string::npos)
      << ran.out;
  EXPECT_NE(ran.out.find("Außenputz                diffuse 0.600"), std::string::npos) << ran.out;
}

TEST(StrangeNames, GoThroughEveryListing) {
  const std::string result = strange().result("results");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"info", result},
        {"info", result, "--patches"},
        {"compare", result, result},
        {"compare", result, result, "--json"},
        {"compare", result, result, "--csv"},
        {"export", result, "--to", "csv", "--quantity", "series"},
        {"export", result, "--to", "cityjson"},
        {"export", result, "--to", "vrml"}}) {
    const Ran ran = program(strange().folder, words);
    EXPECT_EQ(ran.code, 0) << words[0] << "\n" << ran.err;
    EXPECT_TRUE(is_utf8(ran.out)) << words[0];
    EXPECT_EQ(ran.out.find('\x1B'), std::string::npos) << words[0];
  }
  const Ran json = program(strange().folder, {"compare", result, result, "--json"});
  EXPECT_TRUE(nlohmann::json::accept(json.out)) << json.out;
  const Ran csv = program(strange().folder, {"info", result, "--patches"});
  EXPECT_NE(csv.out.find(",\"'=HYPERLINK(\"\"x\"\")\","), std::string::npos);
  EXPECT_EQ(csv.out.find(",\"=HYPER"), std::string::npos);
}

TEST(StrangeNames, AreTextForXarray) {
  const Ran ran = python(strange().folder,
                         "import sys, xarray\n"
                         "data = xarray.open_dataset(sys.argv[1], engine='h5netcdf')\n"
                         "print(list(data['object_name'].values))\n",
                         {strange().result("results")});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("Gebäude"), std::string::npos) << ran.out;
}

/// A result that somebody else has made, and a study whose own words are hostile, at a terminal.
TEST(StrangeNames, OfResultsNeverReachATerminal) {
  const auto& folder = strange().folder;
  std::filesystem::copy_file(strange().result("results"), folder / "hostile.h5");
  const Ran ran = python(folder, R"(
import h5py, os, pty, sys
program = sys.argv[1]
with h5py.File("hostile.h5", "r+") as file:
    names = file["object_name"]
    names[...] = [b"\x1b]0;owned\x07" + bytes(str(k), "ascii") for k in range(len(names))]
    file["facade_name"][...] = b"\xc2\x9b31m"
    file.attrs["variant"] = "\x1b[2J"
seen = []
def keep(descriptor):
    seen.append(os.read(descriptor, 1 << 16))
    return b""
for words in (["info", "hostile.h5"], ["info", "hostile.h5", "--patches"],
              ["compare", "hostile.h5", "hostile.h5"], ["info", "\x1b[31mnone.h5"],
              ["run", "\x1b[31mnone.yaml"], ["\x1b[31mnone"]):
    pty.spawn([program, *words], keep)
text = b"".join(seen)
print(len(text) > 1000, b"\x1b" in text, b"\xc2\x9b" in text, b"\\x1b" in text)
)",
                         {program_path()});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out.substr(
                ran.out.rfind("True False") == std::string::npos ? 0 : ran.out.rfind("True False")),
            "True False False True\n")
      << ran.out;
}

}  // namespace
}  // namespace sunload::test
