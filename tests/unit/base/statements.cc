#include <snug/base/statements.h>

#include <gtest/gtest.h>

using namespace snug;

namespace {
/// Return the message of the error of @p text, or "" if there is no error.
std::string failure(const std::string &text)
{
  try
    {
      parse_statements(text, "a.prm");
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}
} // namespace

TEST(Statements, HaveSectionsValuesAndLines)
{
  const auto               statements = parse_statements("set A  thing = 1 # comment\n"
                                                                       "subsection One\n"
                                                                       "  subsection Two\n"
                                                                       "    set B = x, \\\n"
                                                                       "            y=z\n"
                                                                       "  end\n"
                                                                       "  set C =\n"
                                                                       "end\n",
                                                         "a.prm");
  std::vector<std::string> found;
  for (const auto &statement : statements)
    if (!statement.name.empty())
      found.push_back(statement.path() + "|" + statement.value + "|" + statement.origin.text());
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0], "A thing|1|a.prm, line 1: ");
  EXPECT_EQ(found[1].substr(0, 11), "One/Two/B|x");
  EXPECT_NE(found[1].find("y=z|"), std::string::npos) << found[1];
  EXPECT_EQ(found[2], "One/C||a.prm, line 7: ");
}

TEST(Statements, OfTheCommandLineHaveTheSamePaths)
{
  const auto statement = parse_override("One/Two/B = x=y");
  EXPECT_EQ(statement.path(), "One/Two/B");
  EXPECT_EQ(statement.value, "x=y");
  EXPECT_THROW(parse_override("One/Two/B"), InputError);
}

TEST(Statements, ErrorsContainTheLine)
{
  EXPECT_NE(failure("set A = 1\nAnything\n").find("a.prm, line 2"), std::string::npos);
  EXPECT_NE(failure("set A = 1\nend\n").find("a.prm, line 2"), std::string::npos);
  EXPECT_NE(failure("\nsubsection One\nset A = 1\n").find("a.prm"), std::string::npos);
  EXPECT_NE(failure(std::string("set A = \0b\n", 11)).find("null byte"), std::string::npos);
}

TEST(Statements, SimilarNamesAreProposed)
{
  const std::vector<std::string> known = {"Young's modulus", "Poisson's ratio", "Density"};
  EXPECT_EQ(suggestion("Youngs modulus", known), "Young's modulus");
  EXPECT_EQ(suggestion("Friction coefficient", known), "");
}
