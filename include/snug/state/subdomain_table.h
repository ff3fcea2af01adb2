#ifndef snug_state_subdomain_table_h
#define snug_state_subdomain_table_h

#include <snug/feti/coarse_space.h>
#include <snug/mesh/tearing.h>
#include <snug/state/model.h>


namespace snug::state {
/// Return the bodies of all subdomains, on all ranks: those of the model, then its reference
/// points. Collective.
template <int dim>
feti::SubdomainTable subdomain_table(const mesh::BodyMesh<dim> &mesh,
                                     const mesh::Tearing       &tearing,
                                     const Model<dim>          &model);
} // namespace snug::state

#endif
