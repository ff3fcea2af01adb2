#ifndef snug_state_subdomain_table_h
#define snug_state_subdomain_table_h

#include <snug/feti/coarse_space.h>
#include <snug/mesh/tearing.h>

#include <string>
#include <vector>

namespace snug::state {
/// Return the bodies of all subdomains, on all ranks. Collective.
template <int dim>
feti::SubdomainTable subdomain_table(const mesh::BodyMesh<dim>      &mesh,
                                     const mesh::Tearing            &tearing,
                                     const std::vector<std::string> &body_names);
} // namespace snug::state

#endif
