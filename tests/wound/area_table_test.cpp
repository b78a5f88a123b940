// Area tables in every supported format, and malformed ones.
#include "wound/healing/area_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "base/input_error.hpp"

namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<wound::AreaSeries> read(const std::string& text)
{
    std::istringstream stream(text);
    return wound::read_area_table(stream, "areas.csv");
}

std::string refusal(const std::string& text)
{
    try {
        read(text);
    } catch (const base::InputError& error) {
        return error.what();
    }
    return "";
}

TEST(AreaTable, RatiosAreRelativeToTheFirstDay)
{
    const auto table = read("day,area_mm2\n0,20\n3,15\n7,5\n");
    ASSERT_EQ(table.size(), 1U);
    EXPECT_THAT(table[0].days, ElementsAre(0, 3, 7));
    EXPECT_THAT(table[0].ratios, ElementsAre(1, .75, .25));
}

TEST(AreaTable, UnsortedRowsAreSortedDuplicatesAveragedAndTheFirstDayBecomesZero)
{
    const auto table = read("day,area\n9,5\n2,20\n5,9\n5,11\n");
    EXPECT_THAT(table[0].days, ElementsAre(0, 3, 7));
    EXPECT_THAT(table[0].ratios, ElementsAre(1, .5, .25));
    EXPECT_THAT(table[0].weights, ElementsAre(1, 2, 1));
}

TEST(AreaTable, SemicolonsDecimalCommasQuotesAndByteOrderMarks)
{
    const auto table = read("\xEF\xBB\xBF\"Day\";\"Area (cm2)\"\r\n0;4,0\r\n\r\n# a note\r\n1,5;3,0\r\n");
    EXPECT_THAT(table[0].days, ElementsAre(0, 1.5));
    EXPECT_THAT(table[0].ratios, ElementsAre(1, .75));
    EXPECT_THAT(read("day\tratio\n0\t1\n2\t0.5\n")[0].ratios, ElementsAre(1, .5));
}

TEST(AreaTable, WithoutAHeaderTheFirstColumnsAreDayAndArea)
{
    EXPECT_THAT(read("0,8\n4,2\n")[0].ratios, ElementsAre(1, .25));
}

TEST(AreaTable, ReadersAreAveragedAndRowsThatAllImaginedAreLeftOut)
{
    const auto table = read("wound,day,area_reader1,edge_reader1,area_reader2,edge_reader2\n"
                            "A,0,10,seen,12,seen\n"
                            "A,1,90,imagined,80,imagined\n"
                            "A,2,5,imagined,6,seen\n"
                            "B,0,4,seen,,seen\n"
                            "B,2,1,seen,NA,seen\n");
    ASSERT_EQ(table.size(), 2U);
    EXPECT_EQ(table[0].name, "A");
    EXPECT_THAT(table[0].days, ElementsAre(0, 2));
    EXPECT_THAT(table[0].ratios, ElementsAre(1, .5));
    EXPECT_THAT(table[1].ratios, ElementsAre(1, .25));
    const auto mean = wound::mean_series(table, wound::MeanOf::Ratios);
    EXPECT_EQ(mean.name, "mean");
    EXPECT_THAT(mean.ratios, ElementsAre(1, .375));
}

TEST(AreaTable, GroupsComeFromTheirColumnOrFromPrefixesOfWoundNames)
{
    const std::string rows = "old-1,0,20,x\nold-1,4,10,x\nold-2,0,20,y\nold-2,4,16,y\n"
                             "young-1,0,8,x\nyoung-1,4,2,x\n";
    const auto named = wound::group_means(read("wound,day,area,note\n" + rows));
    ASSERT_EQ(named.size(), 1U); // a group of one wound has no mean
    EXPECT_EQ(named[0].name, "mean old");
    EXPECT_THAT(named[0].ratios, ElementsAre(1, DoubleNear(.65, 1e-12)));
    const auto column = wound::group_means(read("wound,day,area,group\n" + rows));
    ASSERT_EQ(column.size(), 1U);
    EXPECT_EQ(column[0].name, "mean x");
    EXPECT_THAT(column[0].ratios, ElementsAre(1, DoubleNear(12. / 28, 1e-12)));
    EXPECT_TRUE(wound::group_means(read("wound,day,area\na-1,0,2\na-1,1,1\na-2,0,2\na-2,1,1\n")).empty());
}

TEST(AreaTable, RowsLeftOutAreCounted)
{
    const auto table = read("wound,day,area,quality,weight\nA,0,9,seen,1\nA,1,8,imagined,1\nA,2,3,seen,0\n"
                            "A,3,3,seen,\nB,0,4,imagined,1\n");
    ASSERT_EQ(table.size(), 1U);
    EXPECT_EQ(table[0].left_out, 2);
    EXPECT_THAT(table[0].days, ElementsAre(0, 3));
}

TEST(AreaTable, TheMeanOfAreasGivesALargeWoundMoreWeight)
{
    const auto table = read("wound,day,area\na,0,30\na,4,24\nb,0,10\nb,4,2\nb,8,1\n");
    EXPECT_THAT(wound::mean_series(table, wound::MeanOf::Ratios).ratios,
                ElementsAre(1, DoubleNear(.5, 1e-12), DoubleNear(.1, 1e-12)));
    EXPECT_THAT(wound::mean_series(table, wound::MeanOf::Areas).ratios,
                ElementsAre(1, DoubleNear(13. / 20, 1e-12), DoubleNear(1. / 20, 1e-12)));
}

TEST(AreaTable, WeightsApplyAndWeightZeroLeavesOut)
{
    const auto table = read("day,area,weight\n0,10,1\n1,8,3\n1,4,1\n2,99,0\n");
    EXPECT_THAT(table[0].days, ElementsAre(0, 1));
    EXPECT_THAT(table[0].ratios, ElementsAre(1, DoubleNear(.7, 1e-12)));
    EXPECT_THAT(table[0].weights, ElementsAre(1, 4));
}

TEST(AreaTable, MalformedTablesAreRefusedWithLineAndRemedy)
{
    EXPECT_THAT(refusal(""), HasSubstr("areas.csv: the table holds no measurement"));
    EXPECT_THAT(refusal("day,area\n"), HasSubstr("no measurement"));
    EXPECT_THAT(refusal("when,size\n0,1\n"), HasSubstr("names no day column"));
    EXPECT_THAT(refusal("day,area\n0,nan\n"), HasSubstr("line 2: area \"nan\""));
    EXPECT_THAT(refusal("day,area\n0,inf\n"), HasSubstr("inf"));
    EXPECT_THAT(refusal("day,area\n0,-3\n"), HasSubstr("\"-3\""));
    EXPECT_THAT(refusal("day,area\n-1,3\n"), HasSubstr("day \"-1\""));
    EXPECT_THAT(refusal("day,area\n0,ten\n"), HasSubstr("\"ten\""));
    EXPECT_THAT(refusal("day,area\n0,1\n4\n"), HasSubstr("line 3 has 1 columns of 2"));
    EXPECT_THAT(refusal("day,area\n0,0\n4,1\n"), HasSubstr("the area on its first day is 0"));
    EXPECT_THAT(refusal("7\n8\n"), HasSubstr("has no header and 1 columns"));
    EXPECT_THAT(refusal("day,area\n0,5,5\n3,1,25\n"), HasSubstr("line 2 has 3 columns, the header 2"));
    EXPECT_THAT(refusal("0,5,5\n3,1,25\n"), HasSubstr("where commas are decimal, separate by semicolons"));
    EXPECT_THAT(refusal("day,area\n0,1\n3,1e308\n"), HasSubstr("times that of the first day"));
    EXPECT_THROW(wound::read_area_table(std::filesystem::path("/nonexistent/areas.csv")), base::InputError);
}

} // namespace
