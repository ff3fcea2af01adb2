#include <gtest/gtest.h>

#include <nlopt.hpp>

#include <array>
#include <string>
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

using Design = std::array<double, 3>;

/// The questions of a run: a letter for each function, upper case with derivatives, and a space
/// in front of a new design.
struct Record
{
  std::string         letters;
  std::vector<Design> designs;

  void add(const double *x, const char function, const bool with_derivatives)
  {
    const Design design{{x[0], x[1], x[2]}};
    if (designs.empty() || designs.back() != design)
      {
        letters += ' ';
        designs.push_back(design);
      }
    letters += with_derivatives ? static_cast<char>(function - 'a' + 'A') : function;
  }
};

double objective(unsigned int, const double *x, double *gradient, void *record)
{
  static_cast<Record *>(record)->add(x, 'o', gradient != nullptr);
  const double a = x[1] - x[0] * x[0], b = x[2] - x[1] * x[1];
  if (gradient != nullptr)
    {
      gradient[0] = -2. * (1. - x[0]) - 400. * x[0] * a;
      gradient[1] = 200. * a - 2. * (1. - x[1]) - 400. * x[1] * b;
      gradient[2] = 200. * b;
    }
  return (1. - x[0]) * (1. - x[0]) + 100. * a * a + (1. - x[1]) * (1. - x[1]) + 100. * b * b;
}

/// x^2 + y^2 + z^2 = 1
void sphere(unsigned int,
            double *value,
            unsigned int,
            const double *x,
            double       *gradient,
            void         *record)
{
  static_cast<Record *>(record)->add(x, 'e', gradient != nullptr);
  *value = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1.;
  for (unsigned int i = 0; gradient != nullptr && i < 3; ++i)
    gradient[i] = 2. * x[i];
}

/// x + y <= 1.2
void plane(unsigned int,
           double *value,
           unsigned int,
           const double *x,
           double       *gradient,
           void         *record)
{
  static_cast<Record *>(record)->add(x, 'i', gradient != nullptr);
  *value = x[0] + x[1] - 1.2;
  for (unsigned int i = 0; gradient != nullptr && i < 3; ++i)
    gradient[i] = i < 2 ? 1. : 0.;
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

// NLopt 2.7.1, 2.8.0 and 2.11.0 ask these questions. A version that asks others is found here:
// then SlsqpAnswers must be compared with its SLSQP.
TEST(AskingOrder, IsTheRecordedOne)
{
  Record     record;
  nlopt::opt slsqp(nlopt::LD_SLSQP, 3);
  slsqp.set_min_objective(&objective, &record);
  slsqp.add_equality_mconstraint(&sphere, &record, {1e-8});
  slsqp.add_inequality_mconstraint(&plane, &record, {1e-8});
  slsqp.set_lower_bounds(-1.5);
  slsqp.set_upper_bounds(1.5);
  slsqp.set_ftol_rel(1e-10);
  std::vector<double> x = {-0.5, 0.8, 0.3};
  double              f = 0.;
  slsqp.optimize(x, f);
  EXPECT_EQ(record.letters, " OEI OEI oeiOEI OEI oeiOEI OEI oeiOEI OEI OEI OEI OEI OEI");
  const std::vector<Design> designs = {{{-0.5, 0.8, 0.3}},
                                       {{-1.5, -0.262499999, 1.5}},
                                       {{-0.624136393, 0.668105082, 0.448963672}},
                                       {{-1.5, 0.454617277, -0.492683948}},
                                       {{-0.711722754, 0.646756302, 0.35479891}},
                                       {{-0.776790481, 0.502255628, 0.416196815}},
                                       {{-0.742215114, 0.579039681, 0.3835715}},
                                       {{-0.765308533, 0.570918889, 0.307740305}},
                                       {{-0.750468849, 0.573127536, 0.330230587}},
                                       {{-0.750658168, 0.572623595, 0.329568296}},
                                       {{-0.75066648, 0.57261362, 0.32956559}},
                                       {{-0.75066646, 0.572613753, 0.329565404}}};
  ASSERT_EQ(record.designs.size(), designs.size());
  for (std::size_t n = 0; n < designs.size(); ++n)
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(record.designs[n][i], designs[n][i], 1e-7) << n;
}
