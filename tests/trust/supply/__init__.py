"""What mbla is delivered with: lowest and newest versions, the wheel without its sources, no network, licences."""
