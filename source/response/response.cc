#include <snug/response/quantities.h>

namespace snug::response {
namespace {
using Parameters = ResponseParameters;

/// Return the responses of bodies. Work derives its partial derivatives from the given
/// factors of 1/2 u'Ku and f'u.
template <int dim>
ChoiceTable<MakeResponse<dim>> body_responses()
{
  using State = state::ContactState<dim>;
  return {
    {"potential energy",
     "1/2 u'Ku - f'u [force length]; its least value at fixed volume "
     "spreads the contact pressure evenly",
     [](const Parameters &) { return work<dim>(&State::energy, 1., -1.); }},
    {"compliance",
     "f'u, the work of the loads [force length]; with a body held by "
     "contact alone it rewards lifting that body",
     [](const Parameters &) { return work<dim>(&State::compliance, 0., 1.); }},
    {"strain energy", "1/2 u'Ku [force length]",
     [](const Parameters &) { return work<dim>(&State::strain_energy, 1., 0.); }},
    {"volume", "volume of a body or all [length^3]",
     [](const Parameters &parameters) { return body_integral<dim>(parameters, false); }},
    {"mass", "density times volume of a body or all [mass]",
     [](const Parameters &parameters) { return body_integral<dim>(parameters, true); }},
    {"displacement", "a component of that of a point or averaged over a face [length]",
     displacement<dim>},
    {"von Mises norm",
     "p-norm of the von Mises stress over a body or all, divided by that "
     "of 1 [force/length^2]",
     von_mises_norm<dim>},
    {"least scaled Jacobian",
     "quality of the cells of a body or all, to be held by a constraint as >= 0.2: 1 less the "
     "p-norm of 1 - scaled Jacobian, below the least one",
     least_scaled_jacobian<dim>},
    {"least cell size",
     "of a body or all, relative to the reference mesh: 1 less the p-norm of what points of cells "
     "have lost of it, below the least one",
     least_cell_size<dim>}};
}

template <int dim>
ChoiceTable<MakeResponse<dim>> contact_responses()
{
  return {{"contact force",
           "of a pair or all, on the slave side; the component normal adds up "
           "the sizes at all points [force]",
           contact_force<dim>},
          {"contact area",
           "area where the pressure is above the part 'Smoothing' of its mean "
           "[length^2]",
           [](const Parameters &parameters) {
             const double e = parameters.smoothing;
             return contact_measure<dim>(parameters,
                                         [e](const auto &rows) { return contact_area(rows, e); },
                                         {"Smoothing"});
           }},
          {"pressure norm", "p-norm of the contact pressure [force/length^2 length^(2/p)]",
           [](const Parameters &parameters) {
             const double p = parameters.exponent;
             return contact_measure<dim>(
               parameters, [p](const auto &rows) { return pressure_norm(rows, p); }, {"Exponent"},
               p);
           }},
          {"peak pressure",
           "p-norm of the contact pressure, each point weighing as much as the "
           "force it carries [force/length^2]; below the largest pressure",
           [](const Parameters &parameters) {
             const double p = parameters.exponent;
             return contact_measure<dim>(
               parameters, [p](const auto &rows) { return peak_pressure(rows, p); }, {"Exponent"},
               p + 1.);
           }},
          {"pressure variance",
           "mean square of the contact pressure less its mean over the slave "
           "side [(force/length^2)^2]",
           [](const Parameters &parameters) {
             return contact_measure<dim>(parameters, pressure_variance);
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

template const ChoiceTable<MakeResponse<2>> &response_table<2>();
template std::unique_ptr<Response<2>>        make_response<2>(const ResponseParameters &);
template const ChoiceTable<MakeResponse<3>> &response_table<3>();
template std::unique_ptr<Response<3>>        make_response<3>(const ResponseParameters &);
} // namespace snug::response
