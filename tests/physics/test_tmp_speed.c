#include "physics/support.h"
#include <time.h>
static double now(void){struct timespec t; clock_gettime(CLOCK_PROCESS_CPUTIME_ID,&t); return t.tv_sec+1e-9*t.tv_nsec;}
static void timeit(struct lab*lab,const char*name,struct solve_request*r){
 static struct solve_result res; 
 for(int i=0;i<5;i++) lab_solve(lab,r,&res);
 int n=200; double best=1e9; for(int k=0;k<5;k++){double t=now(); for(int i=0;i<n;i++) lab_solve(lab,r,&res); t=(now()-t)/n; if(t<best)best=t;}
 print_message("%s: %.1f us, met %d e %.5f Pt %.4g n %zu modes %d\n",name,best*1e6,res.tolerance_met,res.contacts[0].restitution,res.contacts[0].impulse_tangential[0],res.contacts[0].sub_impact_count, res.bodies[1].modes);
}
static void speed(void**s){(void)s;
 struct lab*lab=lab_create(); lab_add(lab,"ball",make_sphere(STEEL,0.015)); lab_add(lab,"ball2",make_sphere(STEEL,0.015)); lab_add(lab,"beam",make_bar(&beam_kind,ALUMINIUM,0.010,1.0));
 for(int f=0;f<2;f++) for(int t=0;t<2;t++){
  struct solve_request r=strike(sphere_spot("ball",.015),(struct spot){"ball2",{0,0,.015},{0,0,1},0},1.0); r.bodies[0].velocity[0]=.5; r.contacts[0].friction=f?0.3:0; r.options.tolerance=t?1e-4:1e-3; timeit(lab,f?"spheres friction":"spheres",&r);
  struct solve_request b=strike(sphere_spot("ball",.015),side_spot("beam",0,.010,0),.2598); b.bodies[0].velocity[0]=.15; b.contacts[0].friction=f?0.3:0; b.options.tolerance=t?1e-4:1e-3; timeit(lab,f?"beam friction":"beam",&b);
  struct solve_request c=strike(sphere_spot("ball",.015),side_spot("beam",-0.19,.010,0),.2598); c.bodies[0].velocity[0]=.15; c.contacts[0].friction=f?0.3:0; c.options.tolerance=t?1e-4:1e-3; timeit(lab,f?"beam .31 friction":"beam .31",&c);
 } lab_free(lab);}
int main(void){const struct CMUnitTest t[]={cmocka_unit_test(speed)}; return cmocka_run_group_tests(t,NULL,NULL);}
