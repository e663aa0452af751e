// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Bytes of strangers become text that can be stored, printed and opened in a spreadsheet.
#include "io/base/names.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/base/text.h"

namespace sunload {
namespace {

TEST(Names, ThatAreUtf8StayAsTheyAre) {
  for (const std::string name : {"", "house_3/north_1", "Bäume", "日本", "🏠", "\x7E", "€"})
    EXPECT_EQ(clean_name(name), name);
}

TEST(Names, OfOtherEncodingsAreReadAsWindows1252) {
  EXPECT_EQ(utf8_text("B\xE4ume"), "Bäume");
  EXPECT_EQ(utf8_text("\x80 \x96 \xFF"), "€ – ÿ");
  EXPECT_EQ(utf8_text("\x81"), "\uFFFD");
  // A character that is right stays so beside one that is not.
  EXPECT_EQ(utf8_text("ä\xE4"), "ää");
}

TEST(Names, OfBrokenUtf8NeverStayBroken) {
  // Overlong, surrogate, beyond Unicode, cut short, stray continuation (RFC 3629, 3 and 4).
  for (const std::string bytes : {"\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80",
                                  "\xE2\x82", "\xBF", "\xF8\x88\x80\x80\x80"}) {
    const std::string text = utf8_text(bytes);
    EXPECT_NE(text, bytes);
    EXPECT_EQ(utf8_text(text), text);
  }
}

TEST(Names, CommandNoTerminal) {
  EXPECT_EQ(clean_name("a\x1B[31mb"), "a\\x1b[31mb");
  EXPECT_EQ(clean_name("a\nb\tc\x7F"), "a\\x0ab\\x09c\\x7f");
  // The second set of controls, 0x9B opens sequences; as UTF-8 and as what it is in Windows-1252.
  EXPECT_EQ(clean_name("\u009B31m"), "\\x9b31m");
  EXPECT_EQ(clean_name("\x9B"
                       "31m"),
            "›31m");
  EXPECT_EQ(without_controls("a\n\tb\r\x1B"), "a\n\tb\\x0d\\x1b");
}

TEST(CsvText, IsNoFormulaOfASpreadsheet) {
  EXPECT_EQ(csv_text("=1+1"), "'=1+1");
  EXPECT_EQ(csv_text("@SUM(A1)"), "'@SUM(A1)");
  EXPECT_EQ(csv_text("+cmd|' /C calc'!A0"), "'+cmd|' /C calc'!A0");
  EXPECT_EQ(csv_text("-2+3,4"), "\"'-2+3,4\"");
  EXPECT_EQ(csv_text("\t=1"), "'\t=1");
}

TEST(CsvText, LeavesNumbersAndNamesAlone) {
  for (const std::string text : {"-5", "+3.25", "-1e-3", "house", "a=b", "", "2+2", "'quoted'"})
    EXPECT_EQ(csv_text(text), text);
  EXPECT_EQ(csv_text("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_number(-0.5), "-0.5");
}

TEST(NumberText, LeavesLargeNumbersWhole) {
  EXPECT_EQ(number_text(77234.5, 4), "77230");
  EXPECT_EQ(number_text(99.7, 2), "100");
  EXPECT_EQ(number_text(-1.2345e9, 3), "-1230000000");
  EXPECT_EQ(number_text(123.456, 4), "123.5");
  EXPECT_EQ(number_text(3.21e-6, 2), "3.2e-06");
  EXPECT_EQ(cell_text(93200, "{:+.4g}"), "+93200");
  EXPECT_EQ(cell_text(123456, "{:+.4g}"), "+123500");
  EXPECT_EQ(cell_text(std::nan(""), "{:.4g}"), "-");
}

}  // namespace
}  // namespace sunload
