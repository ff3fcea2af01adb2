#include <snug/response/quantities.h>

namespace snug::response {
namespace {
using Parameters = ResponseParameters;

/// Return the response of a face, or that of the reference point if one is given.
template <int dim, auto of_face, auto of_point, bool turns>
std::unique_ptr<Response<dim>> of_face_or_point(const Parameters &parameters)
{
  return parameters.reference_point.empty() ? of_face(parameters) : of_point(parameters, turns);
}

/// Return the responses of bodies. Work derives its partial derivatives from the given
/// factors of 1/2 u'Ku and f'u.
template <int dim>
ChoiceTable<MakeResponse<dim>> body_responses()
{
  using State = state::ContactState<dim>;
  return {
    {"potential energy",
     "strain energy minus compliance, 1/2 u'Ku - f'u [force length]. Its minimum at fixed volume "
     "makes the contact pressure uniform.",
     [](const Parameters &) { return work<dim>(&State::energy, 1., -1.); }},
    {"compliance",
     "f'u, the work of the loads [force length]. It decreases if the design lifts a body that is "
     "held by contact alone.",
     [](const Parameters &) { return work<dim>(&State::compliance, 0., 1.); }},
    {"strain energy",
     "1/2 u'Ku, the elastic energy of bodies and springs, without thermal strains [force length]",
     [](const Parameters &) { return work<dim>(&State::strain_energy, 1., 0.); }},
    {"volume", "volume of one body or all bodies [length^3]",
     [](const Parameters &parameters) { return body_integral<dim>(parameters, false); }},
    {"mass", "density times volume of one body or all bodies [mass]",
     [](const Parameters &parameters) { return body_integral<dim>(parameters, true); }},
    {"displacement",
     "component of the displacement at a point, of a reference point, or of its mean over a face "
     "[length]",
     of_face_or_point<dim, displacement<dim>, point_motion<dim>, false>},
    {"rotation",
     "rotation of the rigid motion nearest to the displacement of a face, about the axis "
     "'Component', positive from x to y about z [rad]. It is the compliance over the moment if "
     "'Moment' of the face is the only load. Or rotation of a reference point.",
     of_face_or_point<dim, rotation<dim>, point_motion<dim>, true>},
    {"reaction",
     "component in space of the force that the supports and springs of a face apply to its nodes, "
     "or the supports of a reference point to the point [force]",
     of_face_or_point<dim, reaction<dim>, point_reaction<dim>, false>},
    {"reaction moment",
     "moment of these forces about the axis 'Component' through 'Point' in space, or of the "
     "supports of a reference point about the point [force length]",
     of_face_or_point<dim, reaction_moment<dim>, point_reaction<dim>, true>},
    {"bolt tension", "force in the shank of a bolt [force]",
     [](const Parameters &parameters) { return point_reaction<dim>(parameters, false); }},
    {"bolt shortening",
     "length by which the sides of the cut of a bolt have moved into each other [length]",
     [](const Parameters &parameters) { return point_motion<dim>(parameters, false); }},
    {"von Mises norm",
     "p-norm of the von Mises stress over one body or all bodies, divided by the p-norm of 1 "
     "[force/length^2]",
     [](const Parameters &parameters) { return von_mises_norm<dim>(parameters, false); }},
    {"yield utilization",
     "von Mises norm of the stress over the 'Yield stress' of its material, which is below the "
     "maximum. Parts without a yield stress are left out.",
     [](const Parameters &parameters) { return von_mises_norm<dim>(parameters, true); }},
    {"least scaled Jacobian",
     "quality of the cells of one body or all bodies, for constraints such as >= 0.2: 1 minus the "
     "p-norm of 1 - scaled Jacobian, which is below the minimum",
     least_scaled_jacobian<dim>},
    {"least cell size",
     "size of the cells of one body or all bodies relative to the reference mesh: 1 minus the "
     "p-norm of the relative reduction at the points of the cells, which is below the minimum",
     least_cell_size<dim>}};
}

template <int dim>
ChoiceTable<MakeResponse<dim>> contact_responses()
{
  return {
    {"contact force",
     "sum of the normal contact forces of one pair or all pairs, or with 'Component' of all "
     "contact "
     "forces on the side that 'Pairs' names first [force]",
     contact_force<dim>},
    {"contact area",
     "area int (1 + e^2) q^2 / (q^2 + e^2 m^2) dA with the pressure q, its mean m weighted by "
     "force, and e = 'Smoothing' [length^2]",
     [](const Parameters &parameters) {
       const double e = parameters.smoothing;
       return contact_measure<dim>(parameters,
                                   [e](const auto &rows) { return contact_area(rows, e); },
                                   {"Smoothing"});
     }},
    {"pressure norm", "(int q^p dA)^(1/p) of the contact pressure q [force/length^2 length^(2/p)]",
     [](const Parameters &parameters) {
       const double p = parameters.exponent;
       return contact_measure<dim>(
         parameters, [p](const auto &rows) { return pressure_norm(rows, p); }, {"Exponent"}, p);
     }},
    {"peak pressure",
     "(int q^p q dA / int q dA)^(1/p) of the contact pressure q [force/length^2], which is "
     "below the maximum",
     [](const Parameters &parameters) {
       const double p = parameters.exponent;
       return contact_measure<dim>(
         parameters, [p](const auto &rows) { return peak_pressure(rows, p); }, {"Exponent"},
         p + 1.);
     }},
    {"pressure variance",
     "int (q - m)^2 dA / int dA of the contact pressure q with its mean m over the slave side "
     "[(force/length^2)^2]",
     [](const Parameters &parameters) {
       return contact_measure<dim>(parameters, pressure_variance);
     }}};
}

template <int dim>
ChoiceTable<MakeResponse<dim>> friction_responses()
{
  const auto power_mean = [](const AmountOf &amount, const bool peak) {
    return [amount, peak](const Parameters &parameters) {
      const double p = parameters.exponent;
      return contact_measure<dim>(
        parameters,
        [p, peak](const auto &rows) {
          return peak ? peak_pressure(rows, p) : pressure_norm(rows, p);
        },
        {"Exponent"}, peak ? p + 1. : p, amount);
    };
  };
  return {
    {"dissipation",
     "work sum q . s of the friction forces q over the slips s of the load step, of one pair or "
     "all pairs [force length]. It is a measure of wear.",
     [](const Parameters &parameters) {
       return contact_measure<dim>(parameters, total, {}, 1., friction_work);
     }},
    {"slip norm", "(int |s|^p dA)^(1/p) of the slip s of the load step [length length^(2/p)]",
     power_mean(slip_over_area, false)},
    {"peak slip",
     "(int |s|^p |s| dA / int |s| dA)^(1/p) of the slip s of the load step [length], which is "
     "below "
     "the maximum",
     power_mean(slip_over_area, true)},
    {"shear norm",
     "(int t^p dA)^(1/p) of the friction force per area t [force/length^2 length^(2/p)]",
     power_mean(shear_force, false)},
    {"peak shear",
     "(int t^p t dA / int t dA)^(1/p) of the friction force per area t [force/length^2], which is "
     "below the maximum",
     power_mean(shear_force, true)},
    {"stick area",
     "area int (1 + e^2) r^2 / (r^2 + e^2 m^2) dA with the reserve r of the friction force per "
     "area "
     "to its limit, its mean m weighted by r, and e = 'Smoothing' [length^2]",
     [](const Parameters &parameters) {
       const double e = parameters.smoothing;
       return contact_measure<dim>(
         parameters, [e](const auto &rows) { return contact_area(rows, e); }, {"Smoothing"}, 1.,
         shear_reserve);
     }},
    {"friction force",
     "component of the sum of the friction forces of one pair or all pairs on the side that "
     "'Pairs' names first [force]",
     friction_force<dim>},
    {"friction moment",
     "moment of these forces about the axis 'Component' through 'Point' in space [force length]",
     friction_moment<dim>}};
}
} // namespace

template <int dim>
const ChoiceTable<MakeResponse<dim>> &response_table()
{
  static const auto table = []() {
    auto       rows     = body_responses<dim>();
    const auto contact  = contact_responses<dim>();
    const auto friction = friction_responses<dim>();
    rows.insert(rows.end(), contact.begin(), contact.end());
    rows.insert(rows.end(), friction.begin(), friction.end());
    return rows;
  }();
  return table;
}

/// The meaning of a quantity gives its unit in the first brackets.
template <int dim>
std::string unit_of(const std::string &quantity)
{
  const std::string &meaning = choose(response_table<dim>(), quantity).meaning;
  const auto         begin = meaning.find('['), end = meaning.find(']');
  return begin == std::string::npos ? "" : meaning.substr(begin + 1, end - begin - 1);
}

template <int dim>
std::unique_ptr<Response<dim>> make_response(const ResponseParameters &parameters)
{
  return choose(response_table<dim>(), parameters.quantity).make(parameters);
}

template const ChoiceTable<MakeResponse<2>> &response_table<2>();
template std::unique_ptr<Response<2>>        make_response<2>(const ResponseParameters &);
template std::string                         unit_of<2>(const std::string &);
template std::string                         unit_of<3>(const std::string &);
template const ChoiceTable<MakeResponse<3>> &response_table<3>();
template std::unique_ptr<Response<3>>        make_response<3>(const ResponseParameters &);
} // namespace snug::response
