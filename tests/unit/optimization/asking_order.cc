#include <gtest/gtest.h>

#include <nlopt.hpp>

#include <vector>

namespace {
struct Question
{
  std::vector<double> x;
  double              f;
  std::vector<double> gradient; ///< empty if not asked for

  bool with_gradient() const { return !gradient.empty(); }
};

/// Answers from Rosenbrock's valley; the questions are listed in @p list.
double answer(const std::vector<double> &x, std::vector<double> &gradient, void *list)
{
  const double bend = x[1] - x[0] * x[0];
  const double f    = (1. - x[0]) * (1. - x[0]) + 100. * bend * bend;
  if (!gradient.empty())
    gradient = {-2. * (1. - x[0]) - 400. * x[0] * bend, 200. * bend};
  static_cast<std::vector<Question> *>(list)->push_back({x, f, gradient});
  return f;
}

std::vector<Question> questions_of_slsqp()
{
  std::vector<Question> questions;
  nlopt::opt            slsqp(nlopt::LD_SLSQP, 2);
  slsqp.set_min_objective(&answer, &questions);
  slsqp.set_ftol_rel(1e-8);
  std::vector<double> x = {-1.2, 1.};
  double              f = 0.;
  slsqp.optimize(x, f);
  return questions;
}

/// Kraft's condition for a step of the line search, where nothing is
/// constrained: a tenth of the descent that the gradient promises.
bool is_descent(const Question &from, const Question &to)
{
  const double slope =
    from.gradient[0] * (to.x[0] - from.x[0]) + from.gradient[1] * (to.x[1] - from.x[1]);
  return to.f - from.f <= slope / 10.;
}
} // namespace

// What SlsqpAnswers reads from the order of NLopt's questions is what the line
// search does: another version of NLopt that asks otherwise is found here.
TEST(AskingOrder, TellsWhichDesignsSlsqpAccepts)
{
  const auto questions = questions_of_slsqp();
  ASSERT_TRUE(questions[0].with_gradient());
  const Question *iterate = &questions[0];
  unsigned int    n_full = 0, n_shortened = 0, n_rejected = 0;
  for (std::size_t i = 1; i + 1 < questions.size(); ++i)
    {
      const Question &question = questions[i], &next = questions[i + 1];
      const bool      repeated = next.x == question.x;
      EXPECT_FALSE(repeated && question.with_gradient()) << i;
      EXPECT_FALSE(repeated && !next.with_gradient()) << i;
      const bool accepted = next.with_gradient() && question.with_gradient() != repeated;
      EXPECT_EQ(accepted, is_descent(*iterate, question)) << i;
      n_full += accepted && !repeated;
      n_shortened += accepted && repeated;
      n_rejected += !accepted;
      if (accepted)
        iterate = &questions[repeated ? ++i : i];
    }
  EXPECT_GT(n_full, 5u);
  EXPECT_GT(n_shortened, 3u);
  EXPECT_GE(n_rejected, n_shortened);
}
