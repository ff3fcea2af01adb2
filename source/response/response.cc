#include <snug/response/body_integral.h>
#include <snug/response/contact_force.h>
#include <snug/response/contact_measure.h>
#include <snug/response/displacement.h>
#include <snug/response/response.h>
#include <snug/response/von_mises_norm.h>
#include <snug/response/work.h>

namespace snug::response {
template <int dim>
void Response<dim>::check(const state::StateSolver<dim> &) const
{}

namespace {
using Parameters = ResponseParameters;

/// Work takes its partial derivatives from the factors of 1/2 u'Ku and f'u that it is given.
template <int dim>
ChoiceTable<MakeResponse<dim>> body_responses()
{
  using State    = state::ContactState<dim>;
  using Integral = BodyIntegral<dim>;
  return {
    {"potential energy",
     "1/2 u'Ku - f'u [force length]; its least value at fixed volume "
     "spreads the contact pressure evenly",
     [](const Parameters &) { return std::make_unique<Work<dim>>(&State::energy, 1., -1.); }},
    {"compliance",
     "f'u, the work of the loads [force length]; with a body held by "
     "contact alone it rewards lifting that body",
     [](const Parameters &) { return std::make_unique<Work<dim>>(&State::compliance, 0., 1.); }},
    {"strain energy", "1/2 u'Ku [force length]",
     [](const Parameters &) { return std::make_unique<Work<dim>>(&State::strain_energy, 1., 0.); }},
    {"volume", "volume of a body or all [length^3]",
     [](const Parameters &parameters) {
       return std::make_unique<Integral>(parameters, Integral::Weight::one);
     }},
    {"mass", "density times volume of a body or all [mass]",
     [](const Parameters &parameters) {
       return std::make_unique<Integral>(parameters, Integral::Weight::density);
     }},
    {"displacement", "a component of that of a point or averaged over a face [length]",
     [](const Parameters &parameters) { return std::make_unique<Displacement<dim>>(parameters); }},
    {"von Mises norm",
     "p-norm of the von Mises stress over a body or all, divided by that "
     "of 1 [force/length^2]",
     [](const Parameters &parameters) { return std::make_unique<VonMisesNorm<dim>>(parameters); }}};
}

template <int dim>
ChoiceTable<MakeResponse<dim>> contact_responses()
{
  using Measure = ContactMeasure<dim>;
  return {{"contact force",
           "of a pair or all, on the slave side; the component normal adds up "
           "the sizes at all points [force]",
           [](const Parameters &parameters) {
             return std::make_unique<ContactForce<dim>>(parameters);
           }},
          {"contact area",
           "area where the pressure is above the part 'Smoothing' of its mean "
           "[length^2]",
           [](const Parameters &parameters) {
             const double e = parameters.smoothing;
             return std::make_unique<Measure>(
               parameters, [e](const auto &rows) { return contact_area(rows, e); },
               std::vector<std::string>{"Smoothing"});
           }},
          {"pressure norm", "p-norm of the contact pressure [force/length^2 length^(2/p)]",
           [](const Parameters &parameters) {
             const double p = parameters.exponent;
             return std::make_unique<Measure>(
               parameters, [p](const auto &rows) { return pressure_norm(rows, p); },
               std::vector<std::string>{"Exponent"});
           }},
          {"peak pressure",
           "p-norm of the contact pressure, each point weighing as much as the "
           "force it carries [force/length^2]; below the largest pressure",
           [](const Parameters &parameters) {
             const double p = parameters.exponent;
             return std::make_unique<Measure>(
               parameters, [p](const auto &rows) { return peak_pressure(rows, p); },
               std::vector<std::string>{"Exponent"});
           }},
          {"pressure variance",
           "mean square of the contact pressure less its mean over the slave "
           "side [(force/length^2)^2]",
           [](const Parameters &parameters) {
             return std::make_unique<Measure>(parameters, pressure_variance);
           }}};
}
} // namespace

template <int dim>
const ChoiceTable<MakeResponse<dim>> &response_table()
{
  static const auto table = []() {
    auto       rows    = body_responses<dim>();
    const auto contact = contact_responses<dim>();
    rows.insert(rows.end(), contact.begin(), contact.end());
    return rows;
  }();
  return table;
}

template <int dim>
std::unique_ptr<Response<dim>> make_response(const ResponseParameters &parameters)
{
  return choose(response_table<dim>(), parameters.quantity).make(parameters);
}

#define SNUG_INSTANTIATE(dim)                                           \
  template class Response<dim>;                                         \
  template const ChoiceTable<MakeResponse<dim>> &response_table<dim>(); \
  template std::unique_ptr<Response<dim>>        make_response<dim>(const ResponseParameters &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::response
