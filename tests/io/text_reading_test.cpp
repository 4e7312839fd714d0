#include <gtest/gtest.h>

#include <clocale>
#include <string>
#include <vector>

#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

using test::attribute_of;
using test::error_of;
using test::read_whole;
using test::TempFolder;
using test::WholeScan;

std::vector<std::string> names_of(const WholeScan& scan) {
  std::vector<std::string> names;
  for (const auto& attribute : scan.attributes) {
    EXPECT_EQ(attribute.type, ScalarType::kFloat64);
    names.push_back(attribute.name);
  }
  return names;
}

TEST(TextReading, EverySeparatorGivesTheSamePoints) {
  const TempFolder folder;
  for (const std::string content :
       {"1 2 3 40\n-5.5 6e2 +7 80\n", "1\t2\t3\t40\n-5.5\t6e2\t+7\t80\n", "1,2,3,40\n-5.5,6e2,+7,80\n",
        "1;2;3;40;\n-5.5;6e2;+7;80;\n", "  1 , 2,\t3,40\n\n -5.5,6e2 ,+7,80", "1  2 \t 3 40  \r\n-5.5 6e2 +7 80\r\n",
        "\xEF\xBB\xBF"
        "1 2 3 40\n# amid\n// amid\n-5.5 6e2 +7 80"}) {
    const WholeScan scan = read_whole(folder.write("a.xyz", content));
    EXPECT_EQ(scan.block.points, Points({{1, 2, 3}, {-5.5, 600, 7}})) << content;
    EXPECT_EQ(names_of(scan), std::vector<std::string>({"column_4"})) << content;
    EXPECT_EQ(attribute_of<double>(scan, 0, "column_4"), 40) << content;
    EXPECT_EQ(attribute_of<double>(scan, 1, "column_4"), 80) << content;
  }
}

TEST(TextReading, TheHeaderNamesTheColumns) {
  const TempFolder folder;
  for (const std::string header : {"id,X,Y,Z,\"Scan Angle\"\n", "# id x y z Scan_Angle\n", "//id;x;y;z;Scan Angle\n",
                                   "## made by hand\n\n#id X Y Z Scan_Angle\n", "id\tx\ty\tz\tScan_Angle\n2\n"}) {
    const WholeScan scan = read_whole(folder.write("a.csv", header + "9,1,2,3,-0.5\n8,4,5,6,0.25\n"));
    EXPECT_EQ(scan.block.points, Points({{1, 2, 3}, {4, 5, 6}})) << header;
    EXPECT_EQ(names_of(scan), std::vector<std::string>({"id", "Scan_Angle"})) << header;
    EXPECT_EQ(attribute_of<double>(scan, 0, "id"), 9) << header;
    EXPECT_EQ(attribute_of<double>(scan, 1, "Scan_Angle"), 0.25) << header;
  }
}

TEST(TextReading, EmptyAndRepeatedNamesAreMadeUp) {
  const TempFolder folder;
  const WholeScan scan = read_whole(folder.write("a.csv", "x,y,z,a,,a,column_5\n1,2,3,4,5,6,7\n"));
  EXPECT_EQ(names_of(scan), std::vector<std::string>({"a", "column_5", "column_6", "column_7"}));
  EXPECT_EQ(attribute_of<double>(scan, 0, "column_7"), 7);
}

TEST(TextReading, ACommentThatIsNoHeaderChangesNothing) {
  const TempFolder folder;
  const WholeScan scan = read_whole(folder.write("a.txt", "# z y x in feet, from the tower\n1 2 3 4\n"));
  EXPECT_EQ(scan.block.points, Points({{1, 2, 3}}));
  EXPECT_EQ(names_of(scan), std::vector<std::string>({"column_4"}));
}

TEST(TextReading, ACountLineIsHeldToItsWord) {
  const TempFolder folder;
  EXPECT_EQ(read_whole(folder.write("a.pts", "2\n1 2 3\n4 5 6\n")).block.points, Points({{1, 2, 3}, {4, 5, 6}}));
  const auto message = [&](const std::string& content) {
    const auto path = folder.write("b.pts", content);
    return error_of<InputError>([&] { read_whole(path); });
  };
  EXPECT_NE(message("3\n1 2 3\n4 5 6\n").find("line 3: ends after 2 points, but the count line promises 3"),
            std::string::npos);
  EXPECT_NE(message("1\n1 2 3\n4 5 6\n").find("line 3: is one point more, but the count line promises 1"),
            std::string::npos);
  EXPECT_NE(message("5\n").find("ends after 0 points"), std::string::npos);
  EXPECT_NE(message("1\n1\n1 2 3\n").find("line 2: is a second count line"), std::string::npos);
}

TEST(TextReading, EverySpellingOfNotANumberIsDroppedAndCounted) {
  const TempFolder folder;
  const WholeScan scan = read_whole(folder.write("a.xyz",
                                                 "nan 0 0\nNaN 0 0\n-nan 0 0\n-nan(ind) 0 0\n0 inf 0\n0 -Infinity 0\n0 "
                                                 "0 1.#QNAN\n0 0 -1.#IND\n0 0 1.#INF\n1 2 3\n"));
  EXPECT_EQ(scan.block.points, Points({{1, 2, 3}}));
  EXPECT_EQ(scan.num_dropped, 9u);
}

TEST(TextReading, AFileOfCommentsHasNoPoints) {
  const TempFolder folder;
  EXPECT_EQ(read_whole(folder.write("a.xyz", "# nothing\n\n###\n")).block.size(), 0u);
  EXPECT_EQ(read_whole(folder.write("b.csv", "x,y,z,i\n")).block.size(), 0u);
}

TEST(TextReading, TheLocaleHasNoSay) {
  const TempFolder folder;
  const auto path = folder.write("a.xyz", "1.5 2.5 3.5\n");
  // Where no such locale is installed the claim is trivially true.
  const char* const german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  const WholeScan scan = read_whole(path);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(scan.block.points, Points({{1.5, 2.5, 3.5}})) << (german ? german : "C");
}

TEST(TextReading, WhatIsWrongIsNamedWithItsPlace) {
  const TempFolder folder;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"1 2 3\n4 five 6\n", "line 2: column 2 holds 'five', which is not a number"},
      {"1 2 3\n4 5\n", "line 2: has 2 columns, but the first point has 3"},
      {"1 2 3\n4 5 6 7\n", "line 2: has 4 columns, but the first point has 3"},
      {"1 2\n", "line 1: has 2 columns, but a point has x, y and z"},
      {"1,2,,4\n", "line 1: column 3 holds '', which is not a number"},
      {"1,5;2,5;3,5\n1.5;2;3\n", "'1.5' is written with a decimal point, but numbers before it with a comma"},
      {"1.5;2;3\n1,5;2;3\n", "'1,5' is written with a decimal comma, but numbers before it with a point"},
      {"1,5;2,5;3,5,5\n", "column 3 holds '3,5,5', which is not a number"},
      {"1 2 3 4e\n", "line 1: column 4 holds '4e'"},
      {"1 2 1e999\n", "line 1: column 3 holds '1e999'"},
      {"east north up\n1 2 3\n", "line 1: begins with 'east', which is neither a number nor a header"},
      {"x y z\nx y z\n1 2 3\n", "line 2: begins with 'x'"},
      {"x y z i\n1 2 3\n", "line 2: has 3 columns, but the header names 4"},
      {std::string("1 2 3\n1 2 \0 3\n", 14), "line 2: has 4 columns"},
  };
  for (const auto& [content, expected] : cases) {
    const auto path = folder.write("broken.xyz", content);
    for (const auto read_attributes : {ReadAttributes::kYes, ReadAttributes::kNo}) {
      const std::string message = error_of<InputError>([&] { read_whole(path, read_attributes); });
      EXPECT_NE(message.find(expected), std::string::npos) << "message: " << message << "\nexpected: " << expected;
      EXPECT_EQ(message.find(path.string()), 0u) << message;
    }
  }
}

TEST(TextReading, DecimalCommasStandWhereTheSeparatorIsNoComma) {
  const TempFolder folder;
  for (const std::string content :
       {"1,5;-2;3,25;4\n5;6,5;7;8,125\n", "1,5 -2 3,25 4\n5 6,5 7 8,125\n", "1,5\t-2\t3,25\t4\n5\t6,5\t7\t8,125\n",
        "X;Y;Z;t\n1,5;-2;3,25;4\n5;6,5;7;8,125\n"}) {
    const WholeScan scan = read_whole(folder.write("a.csv", content));
    EXPECT_EQ(scan.block.points, Points({{1.5, -2, 3.25}, {5, 6.5, 7}})) << content;
    EXPECT_EQ(scan.attributes.size(), 1u) << content;
  }
  for (const std::string content : {"1,2,3\n", "1, 2, 3\n", "1 ,2 ,3\n", "1,2, 3\n"}) {
    EXPECT_EQ(read_whole(folder.write("b.csv", content)).block.points, Points({{1, 2, 3}})) << content;
  }
}

TEST(TextReading, WordsOfSurveyorsNameTheCoordinates) {
  const TempFolder folder;
  for (const std::string header : {"Northing,Easting,Code,Height", "N;E;code;H", "# NORTH East code elevation",
                                   "Northing [m],Easting (m),code,\"Altitude\""}) {
    const WholeScan scan = read_whole(folder.write("a.csv", header + "\n2,1,9,3\n"));
    EXPECT_EQ(scan.block.points, Points({{1, 2, 3}})) << header;
    EXPECT_EQ(scan.attributes.size(), 1u) << header;
  }
  const WholeScan scan = read_whole(folder.write("a.csv", "x,y,z,n,e,h\n1,2,3,4,5,6\n"));
  EXPECT_EQ(scan.block.points, Points({{1, 2, 3}})) << "x y z come first";
}

TEST(TextReading, ColoursAreBytesWhereTheyLookLikeBytes) {
  const TempFolder folder;
  const WholeScan bytes = read_whole(folder.write("a.txt", "x y z R G B\n1 2 3 0 10 255\n4 5 6 7 8 9\n"));
  EXPECT_EQ(attribute_of<std::uint8_t>(bytes, 0, "blue"), 255);
  EXPECT_EQ(attribute_of<std::uint8_t>(bytes, 1, "red"), 7);
  for (const char* const content :
       {"x y z r g b\n1 2 3 0 1 1\n", "x y z r g b\n1 2 3 0.5 1 1\n", "x y z r g b\n1 2 3 7 7 7\n1 2 3 256 0 0\n"}) {
    const WholeScan scan = read_whole(folder.write("b.txt", content));
    EXPECT_EQ(scan.attributes.at(0).name, "red");
    EXPECT_EQ(scan.attributes.at(0).type, ScalarType::kFloat64) << content;
  }
  std::string late = "x y z r g b\n";
  for (int i = 0; i < 20'000; ++i) late += "1 2 3 100 0 0\n";
  const auto path = folder.write("c.txt", late + "1 2 3 256 0 0\n");
  EXPECT_NE(error_of<InputError>([&] { read_whole(path); }).find("line 20002: the red of a point"), std::string::npos);
}

TEST(TextReading, PtsColumnsHaveTheirUsualNames) {
  const TempFolder folder;
  const WholeScan scan = read_whole(folder.write("a.pts", "1\n1 2 3 -1200 10 20 30\n"));
  EXPECT_EQ(attribute_of<double>(scan, 0, "intensity"), -1200);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "green"), 20);
  EXPECT_EQ(read_whole(folder.write("b.pts", "1 2 3 10 20 30\n")).attributes.at(2).name, "blue");
  EXPECT_EQ(read_whole(folder.write("c.pts", "1 2 3 10 20\n")).attributes.at(0).name, "column_4");
}

TEST(TextReading, AMillionColumnsAreNoPoint) {
  const TempFolder folder;
  std::string line;
  for (int i = 0; i < 500'000; ++i) line += "1 ";
  const auto path = folder.write("a.xyz", line + "\n");
  EXPECT_NE(error_of<InputError>([&] { read_whole(path); }).find("has 500000 columns"), std::string::npos);
}

TEST(TextReading, ALineWithoutEndIsRefused) {
  const TempFolder folder;
  const auto one_line = folder.write("a.xyz", std::string(5u << 20, '1'));
  EXPECT_NE(error_of<InputError>([&] { read_whole(one_line); }).find("line 1: is longer than 1 MiB"),
            std::string::npos);
  const auto later = folder.write("b.xyz", "1 2 3\n" + std::string((1u << 20) + 1, ' ') + "\n");
  EXPECT_NE(error_of<InputError>([&] { read_whole(later); }).find("line 2: is longer than 1 MiB"), std::string::npos);
  const auto longest = folder.write("c.xyz", "1 2 3\n" + std::string(1u << 20, ' ') + "\n4 5 6");
  EXPECT_EQ(read_whole(longest).block.points, Points({{1, 2, 3}, {4, 5, 6}}));
}

TEST(TextReading, CommasBetweenColumnsAndWithinNumbersAreRefused) {
  const TempFolder folder;
  const auto message = [&](const std::string& content) {
    return error_of<InputError>([&] { read_whole(folder.write("a.csv", content)); });
  };
  const std::string both = "1,25,2,05,3,75\r\n-4,50,5,25,6,125\r\n";
  EXPECT_NE(message(both).find("line 1: has commas between columns and, as it seems, within numbers"),
            std::string::npos);
  // Whole numbers of six columns, as millimetres and a colour are; a fraction that says otherwise; names of columns.
  for (const char* const content : {"1,2,3,0,50,255\n4,5,6,7,8,9\n", "1,25,2,05,3,75\n1.5,2,3,4,5,6\n",
                                    "01,2,3,04,5,6\n", "x,y,z,a,b,c\n1,25,2,05,3,75\n"}) {
    EXPECT_GE(read_whole(folder.write("a.csv", content)).block.size(), 1U) << content;
  }
}

}  // namespace
}  // namespace tcm_icp
